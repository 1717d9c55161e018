#include "lstm_planner/ros/replay/bag_replay.hpp"

#include <ros/ros.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/base/common/output_file.hpp"

namespace lstm_planner {

namespace {

const ros::WallDuration kSettling(0.5);  // within which a computer that is not too busy makes and serves connections

std::string joined(const std::map<std::string, long>& counts, bool name_first) {
  std::string text;
  for (const auto& [name, count] : counts) {
    const std::string number = std::to_string(count);
    text += (text.empty() ? "" : ", ") + (name_first ? name + " " + number : number + " " + name);
  }
  return text;
}

}  // namespace

BagReplay::BagReplay(const BagReplayParameters& parameters)
    : parameters_(parameters),
      replay_(DrivePolicy::fromFile(resolvePackagePath(parameters.planner.model)), parameters.planner.agent,
              parameters.planner.sensors.scan_rules),
      drive_(recordBag(
          parameters.bag, parameters.drive,
          replayParameters(replay_.description(), parameters.planner.agent, parameters.planner.sensors.scan_rules),
          &replay_)),
      player_(parameters.bag, {drive_.scan_topic, drive_.odometry_source == "tf" ? "" : drive_.odometry_source}),
      // The path is the driver's here, and BagReplayDriver shows it.
      markers_(ros::NodeHandle("~/LstmGlobalPlanner"), replay_.description(), 0),
      decisions_(ros::NodeHandle("~/LstmGlobalPlanner"), replay_.description().actions),
      driver_(ros::NodeHandle("~")) {
  if (replay_.decisions().empty()) {
    throw std::invalid_argument("there is nothing to decide about in '" + parameters_.bag +
                                "': " + describeReplay(replay_));
  }
  if (!drive_.mount_known) {
    ROS_WARN("'%s' does not tell where the scanner sits; it is taken to sit at the robot's centre and look ahead",
             parameters_.bag.c_str());
  }
  if (parameters_.drive.mount || !drive_.mount_known) {
    player_.placeScanner(parameters_.drive.mount.value_or(SensorMount()),
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
    if (markers_.isListenedTo() || decisions_.isListenedTo() || driver_.isListenedTo()) {
      kSettling.sleep();  // its other subscriptions, and others that were started with it, come now
      return;
    }
    ros::WallDuration(0.05).sleep();
  }
}

void BagReplay::showDecisionsUntil(const ros::Time& time) {
  while (shown_ < replay_.decisions().size() && ros::Time(replay_.decisions()[shown_].stamp) <= time) {
    show(replay_.decisions()[shown_++]);
  }
}

void BagReplay::show(const ReplayedDecision& replayed) {
  std_msgs::Header header;
  header.frame_id = drive_.odometry_frame;
  header.stamp = ros::Time(replayed.stamp);
  Situation situation;
  situation.time = replayed.stamp;
  situation.pose = replayed.pose;
  situation.sectors = replayed.sectors;
  markers_.publish(header, situation, replayed.decision, replayed.goal);
  decisions_.publish(header, situation, replayed.decision, replayed.goal);
  driver_.add(replayed, drive_.odometry_frame);
}

std::string describeReplay(const DecisionReplay& replay) {
  std::map<std::string, long> sources;
  for (const ReplayedDecision& replayed : replay.decisions()) {
    ++sources[toString(replayed.decision.source)];
  }
  std::map<std::string, long> rejections;
  for (int i = 0; i < kRejectionCount; ++i) {
    const long count = replay.rejections()[static_cast<std::size_t>(i)];
    if (count > 0) rejections[toString(static_cast<Rejection>(i))] = count;
  }
  const Agreement agreement = agreementOf(replay.decisions());
  const auto percent = [](double share) { return std::to_string(std::lround(100.0 * share)) + " %"; };
  std::ostringstream text;
  text << agreement.decisions << " decisions";
  if (agreement.decisions > 0) {
    const long episodes = replay.decisions().back().episode + 1;
    text << " in " << episodes << (episodes == 1 ? " episode (" : " episodes (") << joined(sources, true)
         << "): the planner took the driver's steering angle at " << agreement.same_action << " ("
         << percent(static_cast<double>(agreement.same_action) / static_cast<double>(agreement.decisions))
         << ", balanced " << percent(agreement.balanced)
         << "; always the driver's most frequent angle: " << percent(agreement.majority) << ", balanced "
         << percent(agreement.majority_balanced) << "), their angles differ by "
         << std::lround(agreement.mean_difference * 180.0 / M_PI) << " degrees on average";
  }
  if (!rejections.empty()) {
    text << "; not decided about: " << joined(rejections, false);
  }
  return text.str();
}

}  // namespace lstm_planner
