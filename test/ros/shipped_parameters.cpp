// The yaml files say that their values are the defaults, and explain every parameter: both must stay true.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include "lstm_planner/ros/plugin_parameters.hpp"
#include "lstm_planner/ros/recorder_node_parameters.hpp"

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

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  ros::init(argc, argv, "shipped_parameters");
  ::testing::InitGoogleTest(&argc, argv);
  ros::Time::init();
  return RUN_ALL_TESTS();
}
