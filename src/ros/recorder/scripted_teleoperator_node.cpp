#include "ros/common/node_main.hpp"
#include "ros/recorder/scripted_teleoperator.hpp"

int main(int argc, char** argv) {
  using namespace lstm_planner;
  // The robot is told to stop at the end.
  return runUntilStopped(argc, argv, "scripted_teleoperator", [](const ros::NodeHandle& node, const auto& stop) {
    return ScriptedTeleoperator(loadTeleoperatorParameters(node)).run(stop);
  });
}
