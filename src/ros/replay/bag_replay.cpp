#include "lstm_planner/ros/replay/bag_replay.hpp"

#include <ros/ros.h>

#include <stdexcept>
#include <utility>

#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "ros/common/node_main.hpp"

namespace lstm_planner {
namespace {

const ros::WallDuration kSettling(0.5);  // within which a computer that is not too busy makes and serves connections

}  // namespace

BagReplay::BagReplay(const BagReplayParameters& parameters)
    : parameters_(parameters),
      replay_(DrivePolicy::fromFile(resolvePackagePath(parameters.planner.model)), parameters.planner.agent,
              parameters.planner.sensors.scan_rules),
      drive_(recordBags(
          {parameters.bag}, parameters.drive,
          replayParameters(replay_.description(), parameters.planner.agent, parameters.planner.sensors.scan_rules),
          &replay_)),
      player_(parameters.bag, {drive_.scan_topic, drive_.odometry_source == "tf" ? "" : drive_.odometry_source}),
      display_(replay_.description()) {
  if (replay_.decisions().empty()) {
    throw std::invalid_argument("there is no step to decide about in '" + parameters_.bag +
                                "': " + describeReplay(replay_));
  }
  if (parameters_.drive.mount) {
    player_.placeScanner(*parameters_.drive.mount,
                         player_.baseFrame().empty() ? parameters_.drive.base_frame : player_.baseFrame());
  }
  if (!parameters_.decisions.empty()) {
    writeDecisionsFile();
  }
}

void BagReplay::writeDecisionsFile() const {
  writeOutputFile("file", parameters_.decisions,
                  [this](std::ostream& file) { writeDecisions(replay_.decisions(), &file); });
}

void BagReplay::run() {
  waitForListeners();
  player_.play(parameters_.rate, [this](const ros::Time& time) { showDecisionsUntil(time); });
  ROS_INFO("%s: %s", parameters_.bag.c_str(), describeReplay(replay_).c_str());
  if (parameters_.stay) {
    ros::spin();
  } else {
    kSettling.sleep();  // so that the last messages still leave
  }
}

void BagReplay::waitForListeners() const {
  const ros::WallTime given_up = ros::WallTime::now() + ros::WallDuration(parameters_.patience);
  while (ros::ok() && ros::WallTime::now() < given_up) {
    if (display_.isListenedTo()) {
      kSettling.sleep();  // its other subscriptions, and others that were started with it, come now
      return;
    }
    ros::WallDuration(0.05).sleep();
  }
}

void BagReplay::showDecisionsUntil(const ros::Time& time) {
  while (shown_ < replay_.decisions().size() && ros::Time(replay_.decisions()[shown_].stamp) <= time) {
    const ReplayedDecision& replayed = replay_.decisions()[shown_++];
    display_.showAdvice(replayed, drive_.odometry_frame);
    display_.showDriver(replayed, drive_.odometry_frame);
  }
}

BagReplayParameters loadBagReplayParameters(const ros::NodeHandle& private_node) {
  BagReplayParameters parameters;
  ParameterReader reader(private_node);
  visitBagReplayParameters(parameters, reader.visitor());
  SensorMount mount;
  reader.know("mount");
  if (readPose(private_node, "mount", &mount.pose)) {
    parameters.drive.mount = mount;
  }
  reader.knowGroup("LstmGlobalPlanner");
  reader.warnOfUnknown();
  parameters.planner = loadGlobalPlannerParameters(ros::NodeHandle(private_node, "LstmGlobalPlanner"));
  if (parameters.bag.empty()) {
    throw std::invalid_argument("parameter " + private_node.resolveName("bag") +
                                " is empty, expected the path of a bag");
  }
  visitBagReplayParameters(std::as_const(parameters), RangeCheck());
  return parameters;
}

}  // namespace lstm_planner

int main(int argc, char** argv) {
  using namespace lstm_planner;
  return runNode(argc, argv, "bag_replay", [](const ros::NodeHandle& node) {
    BagReplay(loadBagReplayParameters(node)).run();
    return 0;
  });
}
