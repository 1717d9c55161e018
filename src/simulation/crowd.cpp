#include "lstm_planner/simulation/crowd.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/text_table.hpp"

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
    Circle body;
    body.radius = uniform(random_, parameters_.smallest_radius, parameters_.largest_radius);
    const double speed = uniform(random_, parameters_.slowest, parameters_.fastest);
    const double distance = parameters_.first_distance + body.radius;
    int tries = 0;
    do {
      if (++tries > kWalkerTries) throw std::invalid_argument("there is no place for a walker away from the robot");
      body.center = drawPlace(body.radius);
    } while (distanceBetween(body.center, robot) < distance);
    circles().push_back(body);
    is_beside_.push_back(false);
    walkers_.push_back({speed, drawPlace(body.radius), 0.0});
  }
}

Point2 Crowd::drawPlace(double radius) {
  for (int i = 0; i < kWalkerTries && !places_.empty(); ++i) {
    const Point2& place = places_[uniformIndex(random_, places_.size())];
    if (!surroundings()->touches(place, radius)) return place;
  }
  throw std::invalid_argument("there is no place for a walker of radius " + numberText(radius) + " m");
}

std::vector<Circle> Crowd::advance(double seconds, const Footprint& robot, const Pose2& pose) {
  std::vector<Circle> meetings;
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    if (step(seconds, robot, pose, i)) meetings.push_back(circles()[i]);
  }
  return meetings;
}

bool Crowd::step(double seconds, const Footprint& robot, const Pose2& pose, std::size_t number) {
  Walker& walker = walkers_[number];
  Circle& circle = circles()[number];
  const double air = airBetween(robot, pose, circle);
  if (air > kMeetingEnds) is_beside_[number] = false;
  if (walker.standing > 0.0) {
    walker.standing -= seconds;
    if (walker.standing <= 0.0) walker.destination = drawPlace(circle.radius);
    return false;
  }
  const double left = distanceBetween(circle.center, walker.destination);
  const double path = std::min(left, walker.speed * seconds);
  const Point2 next = pointAlong(circle.center, directionTo(circle.center, walker.destination), path);
  // One that the robot has pushed against may still walk away from it.
  const double next_air = airBetween(robot, pose, {next, circle.radius});
  if (next_air < 0.0 && next_air < air) {
    walker.standing = uniform(random_, parameters_.shortest_stand, parameters_.longest_stand);
    const bool is_new = !is_beside_[number];
    is_beside_[number] = true;
    return is_new;
  }
  const bool walled = surroundings()->touches(next, circle.radius);
  if (!walled) circle.center = next;
  if (walled || path >= left) walker.destination = drawPlace(circle.radius);
  return false;
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
