#include "tools/robot_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lstm_planner/common/nearest_name.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/drive/plugin_parameters.hpp"
#include "lstm_planner/simulation/create2.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "tools/shared_file.hpp"

namespace lstm_planner {
namespace {

constexpr double kSameDiameter = 0.001;  // m

/// Reads one group of a file into variables that hold their defaults.
class GroupReader {
 public:
  GroupReader(const std::string& file, const YAML::Node& root, const std::string& group)
      : place_(file + ": " + group), group_(root[group]) {}

  /// See parameter_visitors.hpp. Not longer than the reader lives.
  auto visitor() {
    return [this](const std::string& name, auto& value, Range, const char*, const char*) { read(name, &value); };
  }

  /// Throws std::invalid_argument when the group has something that was not read.
  void refuseUnknown() const { refuseUnknown(group_, ""); }

 private:
  template <typename Value>
  void read(const std::string& name, Value* value) {
    known_.push_back(name);
    YAML::Node node = group_;
    std::istringstream parts(name);
    for (std::string part; std::getline(parts, part, '/');) {
      if (!node.IsDefined() || !node.IsMap()) return;
      const YAML::Node inner = std::as_const(node)[part];
      if (!inner.IsDefined()) return;
      node.reset(inner);
    }
    try {
      assign(node, value);
    } catch (const YAML::Exception&) {
      throw std::invalid_argument(place_ + "/" + name + " has the wrong type");
    }
  }

  template <typename Value>
  static void assign(const YAML::Node& node, Value* value) {
    *value = node.as<Value>();
  }
  /// A list, such as a footprint, is the text of it.
  static void assign(const YAML::Node& node, std::string* value) {
    YAML::Emitter text;
    text << YAML::Flow << node;
    *value = node.IsSequence() ? text.c_str() : node.as<std::string>();
  }

  void refuseUnknown(const YAML::Node& node, const std::string& prefix) const {
    if (!node.IsDefined() || node.IsNull()) return;
    if (!node.IsMap()) throw std::invalid_argument(place_ + " is not a group of parameters");
    for (const auto& entry : node) {
      const std::string name = prefix + entry.first.as<std::string>();
      if (contains(known_, name)) continue;
      if (!entry.second.IsMap()) {
        throw std::invalid_argument(place_ + "/" + name + ": there is no parameter of that name" +
                                    hintAtParameter(name, known_));
      }
      refuseUnknown(entry.second, name + "/");
    }
  }

  std::string place_;
  YAML::Node group_;
  std::vector<std::string> known_;
};

template <typename Visitor>
std::optional<HokuyoParameters> readSecondScanner(const Visitor& visit) {
  bool is_mounted = false;
  HokuyoParameters scanner = lookingBack();
  visit("second_laser/is_mounted", is_mounted, {}, "", "");
  visitHokuyoParameters(scanner, withPrefix("second_laser/", visit));
  if (!is_mounted) return std::nullopt;
  return scanner;
}

/// Both plugins have it, and the simulated robot, or none.
void checkSecondScanner(const std::string& path, const SensorParameters& planner, const SensorParameters& controller,
                        bool is_mounted) {
  const std::string& topic = planner.second_scan_topic;
  const std::string because = ": LstmGlobalPlanner/second_scan_topic is '" + topic + "'";
  if (controller.second_scan_topic != topic) {
    throw std::invalid_argument(path + ": SteeringController/second_scan_topic is '" + controller.second_scan_topic +
                                "', expected '" + topic + "'" + because);
  }
  if (is_mounted == topic.empty()) {
    const std::string value = is_mounted ? "true" : "false";
    throw std::invalid_argument(path + ": create2_stub/second_laser/is_mounted is " + value + ", expected " +
                                (is_mounted ? "false" : "true") + because);
  }
}

/// Or another robot would be tried than the one that drives.
void checkBody(const std::string& path, const ShieldParameters& shield, const Create2Parameters& simulated) {
  const auto refuse = [&](const std::string& name, const std::string& value, const std::string& expected) {
    throw std::invalid_argument(path + ": create2_stub/robot/" + name + " is " + value + ", expected " + expected +
                                " as for LstmGlobalPlanner/shield");
  };
  if (simulated.footprint != shield.footprint) {
    refuse("footprint", "'" + simulated.footprint + "'", "'" + shield.footprint + "'");
  }
  const double diameter = 2.0 * shield.footprint_radius;
  if (shield.footprint.empty() && std::abs(simulated.base_diameter - diameter) > kSameDiameter) {
    refuse("base_diameter", std::to_string(simulated.base_diameter), std::to_string(diameter));
  }
}

/// As costmap_2d makes it of a radius: a polygon of 16 corners.
std::vector<Point2> outlineOf(const Footprint& footprint) {
  if (!footprint.isCircle()) return footprint.corners();
  constexpr int kCorners = 16;
  std::vector<Point2> corners;
  for (int i = 0; i < kCorners; ++i) {
    corners.push_back(pointAlong(Point2{}, 2.0 * M_PI * i / kCorners, footprint.circumscribedRadius()));
  }
  return corners;
}

/// Where a costmap's footprint reaches beyond that of the plugins, the real robot would use the costmap's.
void checkCostmap(const std::string& path, const YAML::Node& root, const std::string& costmap, const Footprint& own) {
  double radius = 0.0;
  std::string corners;
  GroupReader group(path, root, costmap);
  const auto visit = group.visitor();
  visit("robot_radius", radius, {}, "", "");
  visit("footprint", corners, {}, "", "");
  if (corners == "[]") corners.clear();  // costmap_2d then takes the radius
  if (radius == 0.0 && corners.empty()) return;
  const std::string name = costmap + (corners.empty() ? "/robot_radius" : "/footprint");
  const double beyond = reachBeyond(own, outlineOf(footprintOf(path + ": " + name, radius, corners)));
  if (beyond == 0.0) return;
  std::ostringstream sentence;
  sentence
      << path << ": " << name << " reaches " << std::fixed << std::setprecision(3) << beyond
      << " m beyond the footprint of the plugins, and the real robot would use that larger footprint; expected the "
         "same one in LstmGlobalPlanner/shield, SteeringController and the costmaps";
  throw std::invalid_argument(sentence.str());
}

bool isMisspelt(const std::string& name, const std::string& group) {
  constexpr std::size_t kMostEdits = 2;  // GlobalPlanner is another planner's
  return name != group && editDistance(name, group) <= kMostEdits;
}

/// Parameters of other nodes may stand in it, too, but not alone.
void checkGroups(const std::string& path, const YAML::Node& root) {
  bool has_one = false;
  for (const auto& entry : root) {
    const std::string name = entry.first.as<std::string>();
    for (const char* group : {"LstmGlobalPlanner", "SteeringController", "create2_stub"}) {
      has_one = has_one || name == group;
      if (!isMisspelt(name, group)) continue;
      throw std::invalid_argument(path + ": there is no group '" + name + "'; the nearest is " + group);
    }
  }
  if (has_one) return;
  throw std::invalid_argument(path +
                              " has none of the groups LstmGlobalPlanner, SteeringController and create2_stub, in "
                              "which a robot file has its values; see config/robots/create2_hokuyo.yaml");
}

}  // namespace

void readRobotFile(const std::string& name, DriveParameters* drive, AgentParameters* agent) {
  const auto [path, root] =
      readShippedYaml("robot", "config/robots", name, "groups of parameters, as in config/robots/create2_hokuyo.yaml");

  checkGroups(path, root);

  GlobalPlannerParameters planner;
  planner.agent = *agent;
  planner.rollout = drive->rollout;
  GroupReader planner_group(path, root, "LstmGlobalPlanner");
  visitGlobalPlannerParameters(planner, planner_group.visitor());
  planner_group.refuseUnknown();
  *agent = planner.agent;
  drive->rollout = planner.rollout;

  SteeringControllerParameters controller;
  controller.motion = drive->motion;
  controller.footprint_radius = agent->shield.footprint_radius;
  controller.footprint = agent->shield.footprint;
  GroupReader controller_group(path, root, "SteeringController");
  visitSteeringControllerParameters(controller, controller_group.visitor());
  controller_group.refuseUnknown();
  drive->motion = controller.motion;
  if (controller.footprint != agent->shield.footprint) {
    throw std::invalid_argument(path + ": SteeringController/footprint is '" + controller.footprint +
                                "', expected the one of LstmGlobalPlanner/shield, '" + agent->shield.footprint + "'");
  }
  // Both look at the same shield here: the larger one is safe for both.
  agent->shield.footprint_radius = std::max(agent->shield.footprint_radius, controller.footprint_radius);

  // What the file does not say of the simulated robot is as for the plugins.
  Create2Parameters& base = drive->robot.base;
  base.footprint = agent->shield.footprint;
  base.base_diameter = 2.0 * agent->shield.footprint_radius;
  base.axle_length = controller.motion.axle_length;
  base.max_wheel_speed = controller.motion.max_wheel_speed;
  GroupReader simulation(path, root, "create2_stub");
  const auto visit = simulation.visitor();
  visitCreate2Parameters(drive->robot.base, withPrefix("robot/", visit));
  visitHokuyoParameters(drive->robot.scanner, withPrefix("laser/", visit));
  drive->robot.second_scanner = readSecondScanner(visit);
  simulation.refuseUnknown();
  checkBody(path, agent->shield, drive->robot.base);
  for (const char* costmap : {"global_costmap", "local_costmap"}) {
    checkCostmap(path, root, costmap, footprintOf(agent->shield));
  }
  checkSecondScanner(path, planner.sensors, controller.sensors, drive->robot.second_scanner.has_value());
}

}  // namespace lstm_planner
