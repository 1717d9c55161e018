// The yaml files say that their values are the defaults, and explain every parameter: both must stay true.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"

namespace lstm_planner {
namespace {

template <typename Parameters>
void expectYamlIsTheDefaults(const std::string& name) {
  ParameterReader reader(ros::NodeHandle("~/" + name));
  Parameters parameters;
  readParameters(&reader, &parameters);
  EXPECT_EQ(reader.unsetParameters(), std::set<std::string>()) << "missing in the yaml";
  EXPECT_EQ(reader.changedParameters(), std::set<std::string>{ros::NodeHandle("~/" + name).resolveName("no_return")})
      << "only the scanner's readings differ from the defaults in the yaml";
  EXPECT_EQ(reader.unknownParameters(), std::vector<std::string>()) << "in the yaml, but not a parameter";
}

TEST(ShippedParameters, PlannerYamlListsEveryParameterWithItsDefault) {
  expectYamlIsTheDefaults<GlobalPlannerParameters>("LstmGlobalPlanner");
}

TEST(ShippedParameters, ControllerYamlListsEveryParameterWithItsDefault) {
  expectYamlIsTheDefaults<SteeringControllerParameters>("SteeringController");
}

TEST(ShippedParameters, RecorderYamlListsEveryParameterWithItsDefault) {
  expectYamlIsTheDefaults<RecorderNodeParameters>("DatasetRecorder");
}

/// Every number that `visit_all` visits is refused by its name when it is none that can be meant.
template <typename Parameters, typename VisitAll, typename Load>
void expectRanges(const std::string& name, const VisitAll& visit_all, const Load& load) {
  const ros::NodeHandle node("~/" + name);
  std::vector<std::string> names;
  Parameters defaults;
  visit_all(defaults, [&](const std::string& number, const auto&, double, double) { names.push_back(number); });
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
      "PlannerRanges", [](auto& p, const auto& visit) { visitPlannerNumbers(p, visit); }, loadGlobalPlannerParameters);
  expectRanges<SteeringControllerParameters>(
      "ControllerRanges", [](auto& p, const auto& visit) { visitControllerNumbers(p, visit); },
      loadSteeringControllerParameters);
  expectRanges<RecorderNodeParameters>(
      "RecorderRanges", [](auto& p, const auto& visit) { visitRecorderNumbers(p.recorder, visit); },
      loadRecorderNodeParameters);
  expectRanges<TeleoperatorParameters>(
      "DriverRanges",
      [](auto& p, const auto& visit) {
        visitDriverNumbers(p.driver, [&](const std::string& number, auto& value, double least, double most) {
          visit("driver/" + number, value, least, most);
        });
      },
      [](const ros::NodeHandle& node) {
        ParameterReader reader(node);
        TeleoperatorParameters parameters;
        readParameters(&reader, &parameters);
      });
}

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  ros::init(argc, argv, "shipped_parameters");
  ::testing::InitGoogleTest(&argc, argv);
  ros::Time::init();
  return RUN_ALL_TESTS();
}
