#include "lstm_planner/simulation/crowd.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace lstm_planner {
namespace {

constexpr double kMeetingEnds = 0.05;    // m of air after which running into the robot again is a new meeting
constexpr double kPlaceDistance = 0.25;  // m
constexpr int kWalkerTries = 2000;

}  // namespace

Crowd::Crowd(const World& surroundings, const std::vector<Point2>& places, const CrowdParameters& parameters,
             const Point2& robot, std::uint64_t seed)
    : Traffic(surroundings), places_(places), parameters_(parameters), random_(seed) {
  for (int i = 0; i < parameters_.walkers; ++i) {
    Walker walker;
    walker.body.radius = uniform(random_, parameters_.smallest_radius, parameters_.largest_radius);
    walker.speed = uniform(random_, parameters_.slowest, parameters_.fastest);
    const double distance = parameters_.first_distance + walker.body.radius;
    int tries = 0;
    do {
      if (++tries > kWalkerTries) throw std::invalid_argument("there is no place for a walker away from the robot");
      walker.body.center = drawPlace(walker.body.radius);
    } while (distanceBetween(walker.body.center, robot) < distance);
    walker.destination = drawPlace(walker.body.radius);
    walkers_.push_back(walker);
  }
  show(bodies());
}

Point2 Crowd::drawPlace(double radius) {
  for (int i = 0; i < kWalkerTries && !places_.empty(); ++i) {
    const Point2& place = places_[uniformIndex(random_, places_.size())];
    if (!surroundings().touches(place, radius)) return place;
  }
  throw std::invalid_argument("there is no place for a walker of radius " + std::to_string(radius) + " m");
}

std::vector<Traffic::Body> Crowd::bodies() const {
  std::vector<Body> bodies;
  for (const Walker& walker : walkers_) bodies.push_back({walker.body, walker.beside_robot});
  return bodies;
}

std::vector<Circle> Crowd::advance(double seconds, const Footprint& robot, const Pose2& pose) {
  std::vector<Circle> meetings;
  for (Walker& walker : walkers_) step(seconds, robot, pose, &walker, &meetings);
  show(bodies());
  return meetings;
}

void Crowd::step(double seconds, const Footprint& robot, const Pose2& pose, Walker* walker,
                 std::vector<Circle>* meetings) {
  const double air = airBetween(robot, pose, walker->body);
  if (air > kMeetingEnds) walker->beside_robot = false;
  if (walker->standing > 0.0) {
    walker->standing -= seconds;
    if (walker->standing <= 0.0) walker->destination = drawPlace(walker->body.radius);
    return;
  }
  const double left = distanceBetween(walker->body.center, walker->destination);
  const double path = std::min(left, walker->speed * seconds);
  const Point2 next = pointAlong(walker->body.center, directionTo(walker->body.center, walker->destination), path);
  // One that the robot has pushed against may still walk away from it.
  const double next_air = airBetween(robot, pose, {next, walker->body.radius});
  if (next_air < 0.0 && next_air < air) {
    if (!walker->beside_robot) meetings->push_back(walker->body);
    walker->beside_robot = true;
    walker->standing = uniform(random_, parameters_.shortest_stand, parameters_.longest_stand);
    return;
  }
  const bool walled = surroundings().touches(next, walker->body.radius);
  if (!walled) walker->body.center = next;
  if (walled || path >= left) walker->destination = drawPlace(walker->body.radius);
}

std::vector<Point2> standingPlaces(const GridWorld& world, double radius) {
  const OccupancyGrid& grid = world.grid();
  std::vector<Point2> places;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (grid.at({column, row}) != Cell::kFree) continue;
      const Point2 center = grid.centerOf({column, row});
      if (!world.touches(center, radius)) places.push_back(center);
    }
  }
  return places;
}

std::vector<Point2> standingPlaces(const World& world, const Point2& low, const Point2& high, double radius) {
  std::vector<Point2> places;
  for (double y = low.y; y <= high.y; y += kPlaceDistance) {
    for (double x = low.x; x <= high.x; x += kPlaceDistance) {
      if (!world.touches({x, y}, radius)) places.push_back({x, y});
    }
  }
  return places;
}

}  // namespace lstm_planner
