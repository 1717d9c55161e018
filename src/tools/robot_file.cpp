#include "tools/robot_file.hpp"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lstm_planner/common/nearest_name.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/drive/plugin_parameters.hpp"
#include "lstm_planner/simulation/create2_stub_parameters.hpp"
#include "tools/shared_file.hpp"

namespace lstm_planner {
namespace {

constexpr double kSameDiameter = 0.001;  // m

/// By their names on the parameter server, where `moving/range: 8` is the same as `moving: {range: 8}`.
using Values = std::map<std::string, YAML::Node>;

/// Collects the values of a file.
class Collector {
 public:
  Collector(const std::string& path, Values* values) : path_(path), values_(*values) {}

  void collect(const YAML::Node& node, const std::string& name, int depth = 0) {
    checkDepth(depth);
    if (!node.IsMap()) {
      if (!values_.emplace(name, node).second) refuseTwice(name);
      return;
    }
    for (const auto& [key, value] : entriesOf(node, name, depth)) collect(value, key, depth + 1);
  }

 private:
  using Entries = std::map<std::string, YAML::Node>;

  /// With those of the groups that it merges (<<: *NAME), as in YAML 1.1, which rosparam reads: its own count more, and
  /// those of an earlier group than those of a later one.
  Entries entriesOf(const YAML::Node& map, const std::string& name, int depth) {
    Entries entries;
    std::vector<YAML::Node> merged;
    for (const auto& entry : map) {
      const std::string key = keyOf(path_, entry.first);
      if (key != "<<") {
        const std::string full = (name.empty() ? "" : name + "/") + key;
        if (!entries.emplace(full, entry.second).second) refuseTwice(full);
      } else if (entry.second.IsSequence()) {
        for (const auto& one : entry.second) merged.push_back(one);
      } else {
        merged.push_back(entry.second);
      }
    }
    for (const YAML::Node& group : merged) {
      if (!group.IsMap()) throw std::invalid_argument(path_ + ": " + name + "/<< is no group of parameters");
      checkDepth(depth + 1);
      entries.merge(entriesOf(group, name, depth + 1));
    }
    return entries;
  }

  void checkDepth(int depth) {
    constexpr int kDeepest = 100;
    constexpr int kMost = 10000;
    if (depth > kDeepest) throw std::invalid_argument(path_ + ": a group stands in itself (&NAME and *NAME)");
    if (++visited_ <= kMost) return;
    throw std::invalid_argument(path_ + ": groups in groups (&NAME and *NAME) make more than 10000 parameters");
  }

  /// Of what is given twice the parameter server keeps the last alone, of a group as well: the rest of the first is
  /// lost.
  [[noreturn]] void refuseTwice(const std::string& what) const {
    throw std::invalid_argument(path_ + ": " + what + " is given twice, and a robot takes the last one alone");
  }

  const std::string& path_;
  Values& values_;
  int visited_ = 0;  ///< parameters and groups
};

/// Reads one group of a file into variables that hold their defaults.
class GroupReader {
 public:
  GroupReader(const std::string& file, const Values& values, const std::string& group)
      : file_(file), values_(values), group_(group) {}

  /// See parameter_visitors.hpp. Not longer than the reader lives.
  auto visitor() {
    return [this](const std::string& name, auto& value, Range, const char*, const char*) { read(name, &value); };
  }

  /// Throws std::invalid_argument when the group has something that was not read.
  void refuseUnknown() const {
    const std::string prefix = group_ + "/";
    for (const auto& [name, node] : values_) {
      if (name == group_ && !node.IsNull()) {
        throw std::invalid_argument(file_ + ": " + name + " is not a group of parameters");
      }
      if (name.compare(0, prefix.size(), prefix) != 0) continue;
      const std::string own = name.substr(prefix.size());
      if (contains(known_, own)) continue;
      throw std::invalid_argument(file_ + ": " + name + ": there is no parameter of that name" +
                                  hintAtParameter(own, known_));
    }
  }

 private:
  template <typename Value>
  void read(const std::string& name, Value* value) {
    known_.push_back(name);
    const auto found = values_.find(group_ + "/" + name);
    if (found == values_.end()) return;
    const YAML::Node& node = found->second;
    try {
      assign(node, value);
    } catch (const YAML::Exception&) {
      throw std::invalid_argument(file_ + ": " + found->first + " is '" + (node.IsNull() ? "" : YAML::Dump(node)) +
                                  "', expected " + kindOf(*value));
    }
  }

  /// A drive starts where its world says.
  void read(const std::string& name, Pose2* /*value*/) {
    for (const char* part : {"", "/x", "/y", "/yaw"}) known_.push_back(name + part);
  }

  // As rosparam, which follows YAML 1.1, and the nodes (ros/common/parameter_value.hpp) take a value.
  static void assign(const YAML::Node& node, double* value) { *value = node.as<double>(); }
  template <typename Whole>
  static void assign(const YAML::Node& node, Whole* value) {
    if (YAML::convert<Whole>::decode(node, *value)) return;
    double number = 0.0;
    assign(node, &number);
    const bool is_whole = number == std::floor(number) && std::abs(number) <= std::numeric_limits<int>::max();
    if (!is_whole) throw YAML::BadConversion(node.Mark());
    *value = static_cast<Whole>(number);
  }
  static void assign(const YAML::Node& node, bool* value) {
    if (!isTruth(node)) throw YAML::BadConversion(node.Mark());
    *value = node.as<bool>();
  }
  /// Quoted it is a text, and so are y and n.
  static bool isTruth(const YAML::Node& node) {
    constexpr const char* kQuoted = "!";
    bool ignored = false;
    return node.IsScalar() && node.Tag() != kQuoted && node.Scalar().size() > 1 &&
           YAML::convert<bool>::decode(node, ignored);
  }
  /// A list, such as a footprint, is the text of it.
  static void assign(const YAML::Node& node, std::string* value) {
    if (node.IsNull() || isTruth(node)) throw YAML::BadConversion(node.Mark());
    YAML::Emitter text;
    text << YAML::Flow << node;
    *value = node.IsSequence() ? text.c_str() : node.as<std::string>();
  }

  static const char* kindOf(double) { return "a number"; }
  static const char* kindOf(bool) { return "true or false"; }
  static const char* kindOf(const std::string&) { return "a text or a list"; }
  template <typename Whole>
  static const char* kindOf(Whole) {
    return "a whole number";
  }

  std::string file_;
  const Values& values_;
  std::string group_;
  std::vector<std::string> known_;
};

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

/// Each plugin knows its own only, and one that the file leaves out is that of a Create 2. With another body simulated,
/// another robot would be tried than the one that drives.
void checkBody(const std::string& path, const ShieldParameters& shield, const SteeringControllerParameters& controller,
               const Create2Parameters& simulated) {
  const auto refuse = [&](const std::string& name, const std::string& value, const std::string& expected) {
    throw std::invalid_argument(path + ": " + name + " is " + value + ", expected " + expected +
                                " as for LstmGlobalPlanner/shield");
  };
  // 0.20 is the same as 0.2.
  const auto cornersOf = [&](const std::string& group, double radius, const std::string& footprint) {
    return textOf(footprintOf(path + ": " + group + "/footprint", radius, footprint));
  };
  const std::string expected = cornersOf("LstmGlobalPlanner/shield", shield.footprint_radius, shield.footprint);
  for (const auto& [name, footprint] : {std::pair<const char*, std::string>{"SteeringController", controller.footprint},
                                        {"create2_stub/robot", simulated.footprint}}) {
    if (cornersOf(name, controller.footprint_radius, footprint) == expected) continue;
    refuse(std::string(name) + "/footprint", "'" + footprint + "'", "'" + shield.footprint + "'");
  }
  if (!shield.footprint.empty()) return;
  if (controller.footprint_radius != shield.footprint_radius) {
    refuse("SteeringController/footprint_radius", numberText(controller.footprint_radius),
           numberText(shield.footprint_radius));
  }
  const double diameter = 2.0 * shield.footprint_radius;
  if (std::abs(simulated.base_diameter - diameter) > kSameDiameter) {
    refuse("create2_stub/robot/base_diameter", numberText(simulated.base_diameter), numberText(diameter));
  }
}

/// Where a costmap's footprint reaches beyond that of the plugins, the real robot would use the costmap's.
void checkCostmap(const std::string& path, const Values& values, const std::string& costmap, const Footprint& own) {
  double radius = 0.0;
  std::string corners;
  GroupReader group(path, values, costmap);
  const auto visit = group.visitor();
  visit("robot_radius", radius, {}, "", "");
  visit("footprint", corners, {}, "", "");
  if (corners == "[]") corners.clear();  // costmap_2d then takes the radius
  if (radius == 0.0 && corners.empty()) return;
  const std::string name = costmap + (corners.empty() ? "/robot_radius" : "/footprint");
  const Footprint footprint = footprintOf(path + ": " + name, radius, corners);
  const double beyond = reachBeyond(own, footprint.isCircle() ? costmapCircle(radius) : footprint.corners());
  if (beyond == 0.0) return;
  throw std::invalid_argument(
      path + ": " + name + " reaches " + fixedText(beyond, 3) +
      " m beyond the footprint of the plugins, and the real robot would use that larger footprint; expected the same "
      "one in LstmGlobalPlanner/shield, SteeringController and the costmaps");
}

bool isMisspelt(const std::string& name, const std::string& group) {
  constexpr std::size_t kMostEdits = 2;  // GlobalPlanner is another planner's
  return name != group && editDistance(name, group) <= kMostEdits;
}

/// Parameters of other nodes may stand in it, too, but not alone.
void checkGroups(const std::string& path, const YAML::Node& root) {
  bool has_one = false;
  for (const auto& entry : root) {
    const std::string key = keyOf(path, entry.first);
    const std::string name = key.substr(0, key.find('/'));
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

void readRobotFile(const std::string& name, DriveParameters* drive, AgentParameters* agent, std::string* model) {
  const auto [path, root] =
      readShippedYaml("robot", "config/robots", name, "groups of parameters, as in config/robots/create2_hokuyo.yaml");

  checkGroups(path, root);
  Values values;
  Collector(path, &values).collect(root, "");

  GlobalPlannerParameters planner;
  planner.agent = *agent;
  planner.rollout = drive->rollout;
  planner.model = *model;
  GroupReader planner_group(path, values, "LstmGlobalPlanner");
  visitGlobalPlannerParameters(planner, planner_group.visitor());
  planner_group.refuseUnknown();
  *agent = planner.agent;
  drive->rollout = planner.rollout;
  const std::string package = "package://lstm_planner/";  // whose files the tool finds without ROS
  *model =
      planner.model.compare(0, package.size(), package) == 0 ? planner.model.substr(package.size()) : planner.model;

  SteeringControllerParameters controller;
  controller.motion = drive->motion;
  GroupReader controller_group(path, values, "SteeringController");
  visitSteeringControllerParameters(controller, controller_group.visitor());
  controller_group.refuseUnknown();
  drive->motion = controller.motion;

  // What the file does not say of the simulated robot is as for the plugins.
  Create2StubParameters stub;
  stub.laser = drive->robot.scanner;
  stub.second_laser = lookingBack();
  stub.robot = drive->robot.base;
  stub.robot.footprint = agent->shield.footprint;
  stub.robot.base_diameter = 2.0 * agent->shield.footprint_radius;
  stub.robot.axle_length = controller.motion.axle_length;
  stub.robot.max_wheel_speed = controller.motion.max_wheel_speed;
  GroupReader simulation(path, values, "create2_stub");
  visitCreate2StubParameters(stub, simulation.visitor());
  simulation.refuseUnknown();
  drive->robot.base = stub.robot;
  drive->robot.scanner = stub.laser;
  drive->robot.second_scanner = stub.has_second_laser ? std::make_optional(stub.second_laser) : std::nullopt;
  checkBody(path, agent->shield, controller, drive->robot.base);
  for (const char* costmap : {"global_costmap", "local_costmap"}) {
    checkCostmap(path, values, costmap, footprintOf(agent->shield));
  }
  checkSecondScanner(path, planner.sensors, controller.sensors, drive->robot.second_scanner.has_value());
}

}  // namespace lstm_planner
