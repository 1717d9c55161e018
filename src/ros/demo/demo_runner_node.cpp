#include "lstm_planner/ros/demo/demo_runner.hpp"
#include "ros/common/node_main.hpp"

int main(int argc, char** argv) {
  using namespace lstm_planner;
  return runNode(argc, argv, "demo_runner",
                 [](const ros::NodeHandle& node) { return DemoRunner(loadDemoParameters(node)).run(); });
}
