#include "lstm_planner/ros/create2_stub_world.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/grid/map_server_map.hpp"

namespace lstm_planner {
namespace {

constexpr double kContactEnds = 0.01;    // m of air after which touching again is a new contact
constexpr double kBumperTravel = 0.005;  // m
constexpr double kBumperBearing = 0.7;   // rad, middle of each half of the bumper

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) {
    const auto first = field.find_first_not_of(" \t\r");
    const auto last = field.find_last_not_of(" \t\r");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return fields;
}

/// One line of a csv file by column name.
class CsvRow {
 public:
  CsvRow(const std::string& where, const std::vector<std::string>& columns, const std::string& line)
      : where_(where), columns_(columns), fields_(split(line)) {}

  double number(const std::string& column) const {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    const auto index = static_cast<std::size_t>(found - columns_.begin());
    const std::string text = index < fields_.size() ? fields_[index] : "";
    std::istringstream stream(text);
    double value = 0.0;
    if (!(stream >> value) || !stream.eof()) {
      throw std::invalid_argument(where_ + ": column " + column + " is '" + text + "', expected a number");
    }
    return value;
  }

 private:
  std::string where_;
  const std::vector<std::string>& columns_;
  std::vector<std::string> fields_;
};

}  // namespace

std::vector<Circle> readCircles(const std::string& path, double default_radius, int world) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) throw std::invalid_argument("circles '" + path + "' cannot be read");
  const std::vector<std::string> columns = split(line);
  const auto has = [&columns](const char* name) {
    return std::find(columns.begin(), columns.end(), name) != columns.end();
  };
  if (!has("x") || !has("y")) {
    throw std::invalid_argument("circles '" + path + "': the first line is '" + line +
                                "', expected the names of the columns, x and y among them");
  }
  std::vector<Circle> circles;
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const CsvRow row("circles '" + path + "', line " + std::to_string(number), columns, line);
    if (has("world") && static_cast<int>(row.number("world")) != world) continue;
    circles.push_back({{row.number("x"), row.number("y")}, has("radius") ? row.number("radius") : default_radius});
  }
  if (circles.empty()) {
    throw std::invalid_argument("circles '" + path + "' holds none" +
                                (has("world") ? " of world " + std::to_string(world) : ""));
  }
  return circles;
}

std::unique_ptr<World> makeWorld(const Create2StubParameters& parameters) {
  if (parameters.map.empty() == parameters.circles.empty()) {
    throw std::invalid_argument(
        "exactly one of the parameters map (a map_server yaml) and circles (a csv) is needed, " +
        std::string(parameters.map.empty() ? "neither" : "both") + " given");
  }
  std::unique_ptr<World> world;
  if (!parameters.map.empty()) {
    try {
      world = std::make_unique<GridWorld>(readMapServerMap(parameters.map, parameters.free_threshold));
    } catch (const MapFileError& error) {
      throw std::invalid_argument(error.what());
    }
  } else {
    world = std::make_unique<CircleWorld>(
        readCircles(parameters.circles, parameters.circle_radius, parameters.circle_world));
  }
  const Point2 start{parameters.start.x, parameters.start.y};
  if (world->touches(start, parameters.robot.base_diameter / 2.0)) {
    std::ostringstream text;
    text << "the robot cannot start at (" << start.x << ", " << start.y << "): something is nearer than its radius of "
         << parameters.robot.base_diameter / 2.0 << " m";
    throw std::invalid_argument(text.str());
  }
  return world;
}

RobotInWorld::RobotInWorld(const World& world, const Create2Parameters& parameters, const Pose2& start,
                           std::uint64_t seed)
    : world_(world), robot_(parameters, start, seed), radius_(parameters.base_diameter / 2.0) {}

void RobotInWorld::step(double seconds) {
  const Pose2 before = robot_.truePose();
  robot_.step(seconds);
  const Pose2 after = robot_.truePose();
  if (world_.touches(Point2{after.x, after.y}, radius_)) {
    // The footprint is a disc: turning on the spot never makes it touch.
    robot_.holdPosition({before.x, before.y, after.yaw});
    if (!in_contact_) ++contacts_;
    in_contact_ = true;
  } else if (in_contact_ && !world_.touches(Point2{after.x, after.y}, radius_ + kContactEnds)) {
    in_contact_ = false;
  }
}

bool RobotInWorld::pressed(bool left) const {
  const Pose2& pose = robot_.truePose();
  const double bearing = left ? kBumperBearing : -kBumperBearing;
  return in_contact_ && world_.touches(pointAlong(pose, pose.yaw + bearing, kBumperTravel), radius_);
}

}  // namespace lstm_planner
