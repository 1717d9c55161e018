#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/create2_stub/create2_stub_parameters.hpp"
#include "lstm_planner/ros/demo/demo_runner.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"
#include "lstm_planner/ros/replay/bag_replay.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/option_number.hpp"
#include "tools/wrapped_text.hpp"

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

/// Appends what it visits.
auto collectIn(Table* table) {
  return [table](const std::string& name, const auto& value, Range range, const char* unit, const char* meaning) {
    table->push_back({name, textOf(value), range.isGiven() ? toText(range) : "", unit, meaning});
  };
}

struct Node {
  const char* name;
  const char* title;
  Table table;
};

std::vector<Node> nodes() {
  const GlobalPlannerParameters planner;
  const SteeringControllerParameters controller;
  const RecorderNodeParameters recorder;
  const Create2StubParameters stub;
  const TeleoperatorParameters driver;
  const BagReplayParameters replay;
  const DemoParameters demo;
  std::vector<Node> all = {{"planner", "LstmGlobalPlanner, config/lstm_planner.yaml", {}},
                           {"controller", "SteeringController, config/steering_controller.yaml", {}},
                           {"recorder", "dataset_recorder, config/dataset_recorder.yaml", {}},
                           {"stub", "create2_stub, config/create2_stub.yaml", {}},
                           {"driver", "scripted_teleoperator, config/scripted_teleoperator.yaml", {}},
                           {"replay", "bag_replay, launch/replay.launch", {}},
                           {"demo", "demo_runner, launch/demo.launch", {}}};
  visitGlobalPlannerParameters(planner, collectIn(&all[0].table));
  visitSteeringControllerParameters(controller, collectIn(&all[1].table));
  visitRecorderNodeParameters(recorder, collectIn(&all[2].table));
  visitCreate2StubParameters(stub, collectIn(&all[3].table));
  visitTeleoperatorParameters(driver, collectIn(&all[4].table));
  visitBagReplayParameters(replay, collectIn(&all[5].table));
  visitDemoParameters(demo, collectIn(&all[6].table));
  return all;
}

void print(const Node& node) {
  std::cout << node.title << "\n";
  for (const Row& row : node.table) {
    const std::string what = row.range + (row.range.empty() || row.unit.empty() ? "" : " ") + row.unit;
    std::cout << "  " << row.name << ": " << row.value << (what.empty() ? "" : "  ") << what << "\n      "
              << wrapped(row.meaning, kTextWidth, kIndent, kIndent) << "\n";
  }
}

}  // namespace

int runParameters(const std::vector<std::string>& arguments) {
  const std::vector<Node> all = nodes();
  std::vector<std::string> names;
  for (const Node& node : all) names.emplace_back(node.name);
  std::string wanted;
  CommandLine line("parameters", "prints the parameters of plugins and nodes: default, range, unit and meaning");
  line.addChoice("of", &wanted, names,
                 "planner, controller, recorder, stub, driver, replay or demo; --of may be left out (default: all)")
      .standsAlone();
  if (!line.parse(arguments)) return 0;
  for (const Node& node : all) {
    if (wanted.empty() || wanted == node.name) print(node);
  }
  return 0;
}

}  // namespace lstm_planner
