// The yaml files say that their values are the defaults, and explain every parameter: both must stay true.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"
#include "ros/fixtures/ros_program.hpp"
#include "ros/fixtures/yaml_differences.hpp"

namespace lstm_planner::shipped_parameters {
namespace {

template <typename Parameters, typename VisitAll>
void expectYamlIsTheDefaults(const std::string& name, const VisitAll& visit_all) {
  const auto yaml = yamlDifferences<Parameters>(ros::NodeHandle("~/" + name), visit_all);
  EXPECT_EQ(yaml.missing, std::set<std::string>());
  EXPECT_EQ(yaml.changed, std::set<std::string>{"no_return"})
      << "only the scanner's readings differ from the defaults in the yaml";
  EXPECT_EQ(yaml.unknown, std::vector<std::string>()) << "in the yaml, but not a parameter";
}

TEST(ShippedParameters, PlannerYamlListsEveryParameterWithItsDefault) {
  expectYamlIsTheDefaults<GlobalPlannerParameters>(
      "LstmGlobalPlanner", [](auto& p, const auto& visit) { visitGlobalPlannerParameters(p, visit); });
}

TEST(ShippedParameters, ControllerYamlListsEveryParameterWithItsDefault) {
  expectYamlIsTheDefaults<SteeringControllerParameters>(
      "SteeringController", [](auto& p, const auto& visit) { visitSteeringControllerParameters(p, visit); });
}

TEST(ShippedParameters, RecorderYamlListsEveryParameterWithItsDefault) {
  expectYamlIsTheDefaults<RecorderNodeParameters>(
      "DatasetRecorder", [](auto& p, const auto& visit) { visitRecorderNodeParameters(p, visit); });
}

/// Every number that `visit_all` visits is refused by its name when it is none that can be meant.
template <typename Parameters, typename VisitAll, typename Load>
void expectRanges(const std::string& name, const VisitAll& visit_all, const Load& load) {
  const ros::NodeHandle node("~/" + name);
  std::vector<std::string> names;
  Parameters defaults;
  visit_all(defaults, [&](const std::string& number, const auto&, Range range, const char*, const char*) {
    if (range.isGiven()) names.push_back(number);
  });
  EXPECT_GT(names.size(), 5u);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const std::string& number : names) {
    for (const double wrong : {std::nan(""), kInfinity, -kInfinity, 1e300, -1e300}) {
      node.setParam(number, wrong);
      try {
        load(node);
        ADD_FAILURE() << number << " may be " << wrong;
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(number), std::string::npos) << error.what();
      }
    }
    node.deleteParam(number);
  }
  EXPECT_NO_THROW(load(node));
}

TEST(ShippedParameters, NumbersOutOfTheirRangeAreRefusedByName) {
  expectRanges<GlobalPlannerParameters>(
      "PlannerRanges", [](auto& p, const auto& visit) { visitGlobalPlannerParameters(p, visit); },
      loadGlobalPlannerParameters);
  expectRanges<SteeringControllerParameters>(
      "ControllerRanges", [](auto& p, const auto& visit) { visitSteeringControllerParameters(p, visit); },
      loadSteeringControllerParameters);
  expectRanges<RecorderNodeParameters>(
      "RecorderRanges", [](auto& p, const auto& visit) { visitRecorderNodeParameters(p, visit); },
      loadRecorderNodeParameters);
  const auto loadDriver = [](ros::NodeHandle node) {
    node.setParam("map", "a map");
    return loadTeleoperatorParameters(node);
  };
  expectRanges<TeleoperatorParameters>(
      "DriverRanges", [](auto& p, const auto& visit) { visitTeleoperatorParameters(p, visit); }, loadDriver);
}

TEST(ShippedParameters, AHalfWidthOfATenthOfAMetreIsTakenByAllThree) {
  const ros::NodeHandle node("~/Tenth");
  node.setParam("footprint_radius", 0.1);
  node.setParam("shield/footprint_radius", 0.1);
  EXPECT_DOUBLE_EQ(loadGlobalPlannerParameters(node).agent.memory.resolution, 0.029);
  EXPECT_DOUBLE_EQ(loadSteeringControllerParameters(node).footprint_radius, 0.1);
  EXPECT_DOUBLE_EQ(loadRecorderNodeParameters(node).recorder.agent.memory.resolution, 0.029);
  const std::string square = "[[0.1, 0.1], [0.1, -0.1], [-0.1, -0.1], [-0.1, 0.1]]";
  node.setParam("footprint", square);
  node.setParam("shield/footprint", square);
  EXPECT_DOUBLE_EQ(loadGlobalPlannerParameters(node).agent.memory.resolution, 0.029);
  EXPECT_EQ(loadSteeringControllerParameters(node).footprint, square);
}

TEST(ShippedParameters, TheRecorderTakesTheRobotFromItsFile) {
  const ros::NodeHandle node("~/RecordedRobot");
  node.setParam("scan_topic", "scan");
  node.setParam("LstmGlobalPlanner/scan_topic", "front/scan");
  node.setParam("LstmGlobalPlanner/no_return", "nan");
  node.setParam("LstmGlobalPlanner/shield/footprint", "[[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]");
  node.setParam("LstmGlobalPlanner/goal_tolerance", 0.1);  // where the planner stops; drivers are less exact
  node.setParam("SteeringController/max_linear", 2.0);
  const RecorderNodeParameters parameters = loadRecorderNodeParameters(node);
  EXPECT_EQ(parameters.scan_topic, "front/scan");
  EXPECT_TRUE(parameters.recorder.scan_rules.nan_is_no_return);
  EXPECT_DOUBLE_EQ(parameters.recorder.agent.shield.footprint_radius, 0.2) << "what it passes";
  EXPECT_DOUBLE_EQ(parameters.recorder.goal_tolerance, RecorderParameters().goal_tolerance);
}

TEST(ShippedParameters, AMisspeltOneIsWarnedOfWithTheNearestName) {
  const ros::NodeHandle node("~/Misspelt");
  node.setParam("step/lenght", 0.5);
  node.setParam("colour", "red");
  ParameterReader reader(node);
  GlobalPlannerParameters parameters;
  visitGlobalPlannerParameters(parameters, reader.visitor());
  const std::string prefix = node.getNamespace() + "/";
  const std::string sentence = " is set, but there is none of that name";
  EXPECT_EQ(reader.warningsOfUnknown(), (std::vector<std::string>{"parameter " + prefix + "colour" + sentence,
                                                                  "parameter " + prefix + "step/lenght" + sentence +
                                                                      "; the nearest is step/length"}));
}

const RosProgram program("shipped_parameters", &runTests);

}  // namespace
}  // namespace lstm_planner::shipped_parameters
