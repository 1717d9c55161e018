#include "ros/create2_stub/create2_stub_world.hpp"

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/csv_file.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"

namespace lstm_planner {
namespace {

constexpr double kContactEnds = 0.01;    // m of air after which touching again is a new contact
constexpr double kBumperTravel = 0.005;  // m
constexpr double kBumperBearing = 0.7;   // rad, middle of each half of the bumper

/// Circles from a csv file whose first line names the columns: x, y (m), optionally radius (m; else `default_radius`)
/// and world (only the lines of that `world` count). Throws std::invalid_argument naming the file, the line and what
/// was expected.
std::vector<Circle> readCircles(const std::string& path, double default_radius, int world) {
  enum Column { kX, kY, kRadius, kWorld };
  const CsvFile file(path, {"x", "y"}, {"radius", "world"});
  std::vector<Circle> circles;
  for (std::size_t line = 0; line < file.lines(); ++line) {
    if (file.has(kWorld) && static_cast<int>(file.number(line, kWorld)) != world) continue;
    const double radius = file.has(kRadius) ? file.number(line, kRadius) : default_radius;
    circles.push_back({{file.number(line, kX), file.number(line, kY)}, radius});
  }
  if (circles.empty()) {
    throw std::invalid_argument("'" + path + "' holds no circles" +
                                (file.has(kWorld) ? " of world " + std::to_string(world) : ""));
  }
  return circles;
}

}  // namespace

std::unique_ptr<World> makeWorld(const Create2StubParameters& parameters) {
  if (parameters.map.empty() == parameters.circles.empty()) {
    throw std::invalid_argument(
        "exactly one of the parameters map (a map_server yaml) and circles (a csv) is needed, " +
        std::string(parameters.map.empty() ? "neither" : "both") + " given");
  }
  std::unique_ptr<World> world;
  if (!parameters.map.empty()) {
    try {
      world = std::make_unique<GridWorld>(readMapServerMap(resolvedPath(parameters.map), parameters.free_threshold));
    } catch (const MapFileError& error) {
      throw std::invalid_argument(error.what());
    }
  } else {
    world = std::make_unique<CircleWorld>(
        readCircles(resolvedPath(parameters.circles), parameters.circle_radius, parameters.circle_world));
  }
  const Footprint footprint = footprintOf(parameters.robot);
  if (world->touches(footprint, parameters.start)) {
    std::ostringstream text;
    text << "the robot cannot start at (" << parameters.start.x << ", " << parameters.start.y << "): something is ";
    if (footprint.isCircle()) {
      text << "nearer than its radius of " << footprint.circumscribedRadius() << " m";
    } else {
      text << "inside its footprint " << parameters.robot.footprint;
    }
    throw std::invalid_argument(text.str());
  }
  return world;
}

void WorldWithRobots::moveRobot(std::size_t robot, const Point2& position) {
  const auto [circle, is_new] = circle_of_.emplace(robot, circles().size());
  if (is_new) circles().push_back({position, radius_});
  circles()[circle->second].center = position;
}

RobotInWorld::RobotInWorld(const World& world, const Create2Parameters& parameters, const Pose2& start,
                           std::uint64_t seed)
    : world_(world), robot_(parameters, start, seed), footprint_(footprintOf(parameters)) {}

void RobotInWorld::step(double seconds) {
  const Pose2 before = robot_.truePose();
  robot_.step(seconds);
  const Pose2 after = robot_.truePose();
  const bool touches = world_.touches(footprint_, after);
  // A disc that turns in place never touches more than before.
  if (touches) robot_.holdPosition({before.x, before.y, footprint_.isCircle() ? after.yaw : before.yaw});
  contacts_.note(touches || (contacts_.isTouching() && world_.touches(footprint_.grown(kContactEnds), after)));
}

bool RobotInWorld::pressed(bool left) const {
  const Pose2& pose = robot_.truePose();
  const double bearing = left ? kBumperBearing : -kBumperBearing;
  const Point2 there = pointAlong(pose, pose.yaw + bearing, kBumperTravel);
  return contacts_.isTouching() && world_.touches(footprint_, {there.x, there.y, pose.yaw});
}

}  // namespace lstm_planner
