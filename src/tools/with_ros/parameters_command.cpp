#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "lstm_planner/common/markdown_table.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/ros/advice/drive_advice.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/demo/demo_runner.hpp"
#include "lstm_planner/ros/move_base/standalone_move_base_parameters.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"
#include "lstm_planner/ros/replay/bag_replay.hpp"
#include "lstm_planner/simulation/create2_stub_parameters.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"

namespace lstm_planner {
namespace {

constexpr std::size_t kIndent = 6;

struct Row {
  std::string name;
  std::string value;
  std::string range;
  std::string unit;
  std::string meaning;
};
using Table = std::vector<Row>;

std::string textOf(bool value) { return value ? "true" : "false"; }
std::string textOf(const std::string& value) { return value.empty() ? "\"\"" : value; }
std::string textOf(const Pose2& pose) {
  return "[" + toText(pose.x) + ", " + toText(pose.y) + ", " + toText(pose.yaw) + "]";
}
std::string textOf(const std::vector<double>& numbers) { return nlohmann::json(numbers).dump(); }
std::string textOf(const std::vector<NamedPose>&) { return "[]"; }
template <typename Number>
std::enable_if_t<kIsNumber<Number>, std::string> textOf(Number value) {
  return toText(static_cast<double>(value));
}

/// What `visit(parameters, visitor)` visits, with the defaults, and behind them other rows.
template <typename Parameters, typename Visit>
Table tableOf(const Parameters& parameters, const Visit& visit, const Table& others = {}) {
  Table table;
  visit(parameters,
        [&](const std::string& name, const auto& value, Range range, const char* unit, const char* meaning) {
          table.push_back({name, textOf(value), range.isGiven() ? toText(range) : "", unit, meaning});
        });
  table.insert(table.end(), others.begin(), others.end());
  return table;
}

struct Node {
  const char* name;
  const char* title;
  const char* file;
  Table table;
  std::vector<std::string> changeable = {};  ///< names of those that may change while it runs
};

// Parameters that no visitor visits, as their values are lists and poses, or as others read them.
const Row kMount = {"mount", "from tf", "", "m, m, rad", "pose [x, y, yaw] of the scanner on the robot"};
const Row kDemoStart = {"start", "scenario/start", "", "m, m, rad",
                        "start pose [x, y, yaw] of the robot in the map frame"};
const Row kScenarioStart = {"scenario/start", "[0, 0, 0]", "", "m, m, rad",
                            "start pose [x, y, yaw] in the map frame, if start is not set"};
const Table kScenario = {
    {"scenario/frame", "map", "", "", "frame of the goals: map or odom"},
    {"scenario/time_limit", "300", "[0.1, 86400]", "s", "for each goal that has no time_limit of its own"},
    {"scenario/goals", "[]", "", "m, rad",
     "list of {name, x, y, yaw, time_limit}; must be set, see config/demo_goals.yaml"}};
const Table kCostmaps = {
    {"global_costmap/global_frame", "odom", "", "", "frame of the plans; local_costmap has the same three parameters"},
    {"global_costmap/robot_base_frame", "base_footprint", "", "", "the robot's frame"},
    {"global_costmap/transform_tolerance", "0.3", "", "s", "the robot's pose is unknown if its transform is older"}};

std::vector<Node> nodes() {
  Table demo_rows = {kDemoStart, kScenarioStart};
  demo_rows.insert(demo_rows.end(), kScenario.begin(), kScenario.end());
  return {
      {"planner", "LstmGlobalPlanner", "config/lstm_planner.yaml",
       tableOf(GlobalPlannerParameters(), [](auto& p, const auto& visit) { visitGlobalPlannerParameters(p, visit); }),
       changeableGlobalPlannerParameters()},
      {"controller", "SteeringController", "config/steering_controller.yaml",
       tableOf(SteeringControllerParameters(),
               [](auto& p, const auto& visit) { visitSteeringControllerParameters(p, visit); }),
       changeableSteeringControllerParameters()},
      {"recorder", "dataset_recorder", "config/dataset_recorder.yaml",
       tableOf(RecorderNodeParameters(), [](auto& p, const auto& visit) { visitRecorderNodeParameters(p, visit); })},
      {"stub", "create2_stub", "config/create2_stub.yaml",
       tableOf(Create2StubParameters(), [](auto& p, const auto& visit) { visitCreate2StubParameters(p, visit); },
               {kScenarioStart})},
      {"driver", "scripted_teleoperator", "config/scripted_teleoperator.yaml",
       tableOf(TeleoperatorParameters(), [](auto& p, const auto& visit) { visitTeleoperatorParameters(p, visit); })},
      {"replay", "bag_replay", "launch/replay.launch",
       tableOf(BagReplayParameters(), [](auto& p, const auto& visit) { visitBagReplayParameters(p, visit); },
               {kMount})},
      {"advice", "drive_advice", "launch/advice.launch",
       tableOf(DriveAdviceParameters(), [](auto& p, const auto& visit) { visitDriveAdviceParameters(p, visit); })},
      {"demo", "demo_runner", "launch/demo.launch",
       tableOf(
           DemoParameters(), [](auto& p, const auto& visit) { visitDemoParameters(p, visit); }, demo_rows)},
      {"move_base", "standalone_move_base", "config/move_base.yaml",
       tableOf(
           StandaloneMoveBaseParameters(),
           [](auto& p, const auto& visit) { visitStandaloneMoveBaseParameters(p, visit); }, kCostmaps)}};
}

void print(const Node& node) {
  std::cout << node.title << ", " << node.file << "\n";
  for (const Row& row : node.table) {
    const std::string what = row.range + (row.range.empty() || row.unit.empty() ? "" : " ") + row.unit;
    std::cout << "  " << row.name << ": " << row.value << (what.empty() ? "" : "  ") << what << "\n      "
              << wrapped(row.meaning, kTextWidth, kIndent, kIndent) << "\n";
  }
}

void printAsTable(const Node& node) {
  std::cout << "\n## " << node.title << "\n\n`" << node.file << "`\n\n";
  MarkdownTable table({"parameter", "default", "range", "unit", "live", "meaning"}, &std::cout);
  for (const Row& row : node.table) {
    table.row({"`" + row.name + "`", "`" + row.value + "`", row.range, row.unit,
               contains(node.changeable, row.name) ? "yes" : "", row.meaning});
  }
}

/// The page config/parameters.md.
void printMarkdown(const std::vector<Node>& nodes) {
  std::cout
      << "# All parameters\n\n"
         "Printed by `lstm_planner parameters --markdown`. The parameters of a node are in its private namespace, "
         "those of a plugin in\n`~/PLUGIN`. Live: may change while the robot drives. The last column says what a "
         "parameter means and what a larger or smaller\nvalue changes.\n";
  for (const Node& node : nodes) printAsTable(node);
}

}  // namespace

int runParameters(const std::vector<std::string>& arguments) {
  std::vector<Node> all = nodes();
  std::vector<std::string> names;
  for (const Node& node : all) names.emplace_back(node.name);
  std::string wanted;
  bool markdown = false;
  CommandLine line("parameters", "prints the parameters of plugins and nodes: default, range, unit and meaning");
  line.addChoice("of", &wanted, names,
                 "planner, controller, recorder, stub, driver, replay, advice, demo or move_base; --of may be left out "
                 "(default: all)")
      .standsAlone();
  line.addFlag("markdown", &markdown, true, "print tables in Markdown, as in config/parameters.md");
  if (!line.parse(arguments)) return 0;
  if (!wanted.empty()) {
    all.erase(std::remove_if(all.begin(), all.end(), [&](const Node& node) { return wanted != node.name; }), all.end());
  }
  if (markdown) {
    printMarkdown(all);
  } else {
    for (const Node& node : all) print(node);
  }
  return 0;
}

}  // namespace lstm_planner
