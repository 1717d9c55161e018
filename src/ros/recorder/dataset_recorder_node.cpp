#include "ros/common/node_main.hpp"
#include "ros/recorder/dataset_recorder.hpp"

int main(int argc, char** argv) {
  using namespace lstm_planner;
  // What was heard is written and said at the end.
  return runUntilStopped(argc, argv, "dataset_recorder", [](const ros::NodeHandle& node, const auto& stop) {
    return DatasetRecorder(loadRecorderNodeParameters(node)).run(stop);
  });
}
