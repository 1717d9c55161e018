#include "lstm_planner/ros/advice/drive_advice.hpp"
#include "ros/common/node_main.hpp"

int main(int argc, char** argv) {
  using namespace lstm_planner;
  // How often both agreed is said at the end.
  return runUntilStopped(argc, argv, "drive_advice", [](const ros::NodeHandle& node, const auto& stop) {
    return DriveAdvice(loadDriveAdviceParameters(node)).run(stop);
  });
}
