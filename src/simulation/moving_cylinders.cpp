#include "lstm_planner/simulation/moving_cylinders.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace lstm_planner {
namespace {

constexpr double kCylinderRadius = 0.5;  // m
constexpr double kStretch = 2.0;         // m of x
constexpr double kPathStep = 0.1;        // m of x
constexpr double kShortestPath = 5.0;    // m of x, of a path
constexpr double kFirstDistance = 3.0;   // m
constexpr double kCell = 0.1;            // m
constexpr int kCylinderTries = 1000;
constexpr double kOpenFloor = 3.0;  // m of x, in front of the square's open side

/// The polynomial through the points, at x (Lagrange).
double polynomialAt(const std::vector<Point2>& points, double x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double term = points[i].y;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k != i) term *= (x - points[k].x) / (points[i].x - points[k].x);
    }
    sum += term;
  }
  return sum;
}

double wholeNumber(Random& random, double least, double most) {
  return least + static_cast<double>(uniformIndex(random, static_cast<std::size_t>(most - least) + 1));
}

}  // namespace

DynaBarnClass dynaBarnClassOf(int number) {
  return static_cast<DynaBarnClass>(std::min(2, number / kDynaBarnWorldsAClass));
}

const char* toString(DynaBarnClass difficulty) {
  constexpr std::array<const char*, 3> kNames = {"easy", "medium", "hard"};
  return kNames.at(static_cast<std::size_t>(difficulty));
}

MovingCylindersParameters drawMovingCylinders(int number, std::uint64_t seed) {
  Random random(seed);
  const DynaBarnClass difficulty = dynaBarnClassOf(number);
  const bool is_even = number % 2 == 0;
  const bool is_hard_motion = difficulty == DynaBarnClass::kHard || (difficulty == DynaBarnClass::kMedium && is_even);
  const bool are_many = difficulty == DynaBarnClass::kHard || (difficulty == DynaBarnClass::kMedium && !is_even);
  MovingCylindersParameters parameters;
  parameters.cylinders = static_cast<int>(are_many ? wholeNumber(random, 10, 20) : wholeNumber(random, 5, 10));
  parameters.order = static_cast<int>(is_hard_motion ? wholeNumber(random, 3, 4) : wholeNumber(random, 1, 2));
  parameters.slowest = is_hard_motion ? 1.0 : 0.5;
  parameters.fastest = is_hard_motion ? 2.0 : 1.0;
  parameters.spread = is_hard_motion ? uniform(random, 0.1, 0.2) : uniform(random, 0.01, 0.1);
  return parameters;
}

OccupancyGrid cylindersFloor() {
  const int side = static_cast<int>(std::lround(2.0 * kCylindersArea / kCell));
  const int beyond = static_cast<int>(std::lround(kOpenFloor / kCell));
  OccupancyGrid grid(side + beyond, side, kCell, {-kCylindersArea, -kCylindersArea, 0.0});
  for (int i = 0; i < side; ++i) {
    grid.set({0, i}, Cell::kOccupied);
    grid.set({i, 0}, Cell::kOccupied);
    grid.set({i, side - 1}, Cell::kOccupied);
  }
  return grid;
}

MovingCylinders::MovingCylinders(const World& surroundings, const MovingCylindersParameters& parameters,
                                 const Point2& robot, std::uint64_t seed)
    : Traffic(surroundings), parameters_(parameters), random_(seed) {
  for (int i = 0; i < parameters_.cylinders; ++i) {
    routes_.push_back(drawRoute(robot));
    circles().push_back({routes_.back().corners.front(), kCylinderRadius});
    is_beside_.push_back(false);
  }
}

MovingCylinders::Route MovingCylinders::drawRoute(const Point2& robot) {
  for (int i = 0; i < kCylinderTries; ++i) {
    Route route;
    route.corners = drawPath();
    if (route.corners.empty()) continue;
    if (uniformIndex(random_, 2) == 0) std::reverse(route.corners.begin(), route.corners.end());
    if (distanceBetween(route.corners.front(), robot) < kFirstDistance + kCylinderRadius) continue;
    const double mean = uniform(random_, parameters_.slowest, parameters_.fastest);
    double speed = 0.0;
    double next_stretch = 0.0;
    for (std::size_t k = 0; k + 1 < route.corners.size(); ++k) {
      if (static_cast<double>(k) * kPathStep >= next_stretch) {
        speed = drawSpeed(mean);
        next_stretch += kStretch;
      }
      route.speeds.push_back(speed);
    }
    return route;
  }
  throw std::invalid_argument("there is no path for a cylinder away from the robot");
}

/// The longest piece of a polynomial inside the square; none where that is short.
std::vector<Point2> MovingCylinders::drawPath() {
  std::vector<Point2> points;
  while (static_cast<int>(points.size()) <= parameters_.order) {
    const Point2 point{wholeNumber(random_, -kCylindersArea, kCylindersArea),
                       wholeNumber(random_, -kCylindersArea, kCylindersArea)};
    const auto isSame = [&](const Point2& other) { return other.x == point.x; };
    if (std::none_of(points.begin(), points.end(), isSame)) points.push_back(point);
  }
  std::vector<Point2> longest;
  std::vector<Point2> piece;
  for (int i = 0; i <= std::lround(2.0 * kCylindersArea / kPathStep); ++i) {
    const double x = -kCylindersArea + i * kPathStep;
    const double y = polynomialAt(points, x);
    if (std::abs(y) > kCylindersArea) {
      piece.clear();
      continue;
    }
    piece.push_back({x, y});
    if (piece.size() > longest.size()) longest = piece;
  }
  if (static_cast<double>(longest.size()) * kPathStep < kShortestPath) longest.clear();
  return longest;
}

double MovingCylinders::drawSpeed(double mean) {
  for (int i = 0; i < kCylinderTries; ++i) {
    const double speed = mean + parameters_.spread * normal(random_);
    if (speed >= parameters_.slowest && speed <= parameters_.fastest) return speed;
  }
  return mean;
}

Point2 MovingCylinders::advance(double seconds, Route* route) {
  double left = seconds;
  for (;;) {
    const Point2& from = route->corners[route->stretch];
    const Point2& to = route->corners[route->stretch + 1];
    const double speed = route->speeds[route->stretch];
    const double rest = distanceBetween(from, to) - route->along;
    if (left * speed < rest) {
      route->along += left * speed;
      return pointAlong(from, directionTo(from, to), route->along);
    }
    left -= rest / speed;
    route->along = 0.0;
    route->stretch = (route->stretch + 1) % (route->corners.size() - 1);
  }
}

std::vector<Circle> MovingCylinders::advance(double seconds, const Footprint& robot, const Pose2& pose) {
  std::vector<Circle> meetings;
  for (std::size_t i = 0; i < routes_.size(); ++i) {
    Circle& body = circles()[i];
    body.center = advance(seconds, &routes_[i]);
    const bool meets = airBetween(robot, pose, body) < 0.0;
    if (meets && !is_beside_[i]) meetings.push_back(body);
    is_beside_[i] = meets;
  }
  return meetings;
}

}  // namespace lstm_planner
