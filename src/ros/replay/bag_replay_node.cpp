#include "lstm_planner/ros/replay/bag_replay.hpp"
#include "ros/common/node_main.hpp"

int main(int argc, char** argv) {
  using namespace lstm_planner;
  return runNode(argc, argv, "bag_replay", [](const ros::NodeHandle& node) {
    BagReplay(loadBagReplayParameters(node)).run();
    return 0;
  });
}
