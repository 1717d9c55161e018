#include "lstm_planner/ros/replay/bag_replay.hpp"

#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/ros.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/practice/decision_replay.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/recorder/bag_drive.hpp"
#include "lstm_planner/ros/replay/decision_display.hpp"
#include "ros/common/node_main.hpp"
#include "ros/recorder/bag_message.hpp"
#include "ros/recorder/stamp_check.hpp"

namespace lstm_planner {
namespace {

const ros::WallDuration kSettling(0.5);  // within which a computer that is not too busy makes and serves connections
constexpr int kQueue = 1000;             // what is played as fast as possible comes faster than it is sent

/// As costmap_2d names what it publishes, of the same type as the map, several times a second.
bool isCostmap(const std::string& topic) { return boost::algorithm::ends_with(topic, "/costmap"); }

/// Plays the scans, odometry, transforms and map of a bag on /clock, scan, odom, /tf, /tf_static and map.
///
/// The clock is the sensors', from which the recording computer's may differ. Where the bag has no transforms of its
/// own, the robot's pose comes from the odometry. What recordBags() had to skip is not played.
class BagReplayPlayer {
 public:
  /// `drive`: what recordBags() has made of the bag.
  BagReplayPlayer(const std::string& path, const BagDriveResult& drive);

  /// Tells viewers where the scanner sits, for bags that do not.
  void placeScanner(const SensorMount& mount);

  /// `rate`: s of the recording in a second, 0 = as fast as possible. `at` is called with the time of the recording
  /// before each of its messages. Ends early when the node is shut down.
  void play(double rate, const std::function<void(const ros::Time&)>& at);

 private:
  void waitUntil(const ros::Time& time, double rate);
  void tellTime(const ros::Time& time);
  void publish(const rosbag::MessageInstance& message);
  void publishPose(const nav_msgs::Odometry& odometry);

  rosbag::Bag bag_;
  BagDriveResult drive_;
  StampCheck stamps_;

  ros::NodeHandle node_;
  ros::Publisher clock_;
  ros::Publisher scans_;
  ros::Publisher odometry_;
  ros::Publisher transforms_;
  ros::Publisher map_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  std::optional<ros::Time> began_;  ///< of the recording
  ros::SteadyTime wall_began_;
};

BagReplayPlayer::BagReplayPlayer(const std::string& path, const BagDriveResult& drive)
    : drive_(drive),
      clock_(node_.advertise<rosgraph_msgs::Clock>("/clock", kQueue)),
      scans_(node_.advertise<sensor_msgs::LaserScan>("scan", kQueue)),
      odometry_(node_.advertise<nav_msgs::Odometry>("odom", kQueue)),
      transforms_(node_.advertise<tf2_msgs::TFMessage>("/tf", kQueue)),
      map_(node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true)) {
  bag_.open(path);
}

void BagReplayPlayer::placeScanner(const SensorMount& mount) {
  static_transforms_.sendTransform(mountToMessage(mount, drive_.base_frame, drive_.scan_frame));
}

void BagReplayPlayer::play(double rate, const std::function<void(const ros::Time&)>& at) {
  rosbag::View view(bag_);
  stamps_ = StampCheck();
  began_.reset();
  for (const rosbag::MessageInstance& message : view) {
    if (!ros::ok()) {
      return;
    }
    // What was recorded before the sensors' clock began, as a simulator's, is of its zero.
    const auto received = static_cast<std::int64_t>(message.getTime().toNSec());
    ros::Time time;
    time.fromNSec(
        static_cast<std::uint64_t>(std::max<std::int64_t>(0, received - drive_.clock_difference.value_or(0))));
    waitUntil(time, rate);
    tellTime(time);
    at(time);
    try {
      publish(message);
    } catch (const ros::Exception&) {
      // Its bytes are not those of such a message.
    }
  }
}

void BagReplayPlayer::waitUntil(const ros::Time& time, double rate) {
  constexpr double kClockPeriod = 0.02;  // s of the computer's, also where the recording is silent
  if (!began_) {
    began_ = time;
    wall_began_ = ros::SteadyTime::now();
  }
  if (rate <= 0.0) {
    return;
  }
  const ros::SteadyTime due = wall_began_ + ros::WallDuration((time - *began_).toSec() / rate);
  for (ros::SteadyTime now = ros::SteadyTime::now(); now < due && ros::ok(); now = ros::SteadyTime::now()) {
    tellTime(*began_ + ros::Duration((now - wall_began_).toSec() * rate));
    std::min(ros::WallDuration(kClockPeriod), due - now).sleep();
  }
}

void BagReplayPlayer::tellTime(const ros::Time& time) {
  rosgraph_msgs::Clock clock;
  clock.clock = time;
  clock_.publish(clock);
}

void BagReplayPlayer::publish(const rosbag::MessageInstance& message) {
  const auto isPlausible = [&](const auto& stamped) {
    return stamps_.isPlausible(stamped.header.stamp.toSec(), message.getTime().toSec());
  };
  const std::string& topic = message.getTopic();
  if (topic == drive_.scan_topic) {
    const auto scan = messageOf<sensor_msgs::LaserScan>(message);
    if (scan && isPlausible(*scan)) scans_.publish(scan);
  } else if (topic == drive_.transforms) {
    const auto transforms = messageOf<tf2_msgs::TFMessage>(message);
    if (!transforms) return;
    tf2_msgs::TFMessage plausible;
    std::copy_if(transforms->transforms.begin(), transforms->transforms.end(), std::back_inserter(plausible.transforms),
                 isPlausible);
    transforms_.publish(plausible);
  } else if (topic == drive_.odometry_source) {
    const auto odometry = messageOf<nav_msgs::Odometry>(message);
    if (!odometry || !isPlausible(*odometry)) return;
    odometry_.publish(odometry);
    if (drive_.transforms.empty()) publishPose(*odometry);
  } else if (topic == drive_.static_transforms) {
    const auto transforms = messageOf<tf2_msgs::TFMessage>(message);
    if (transforms) static_transforms_.sendTransform(transforms->transforms);
  } else if (const auto map = isCostmap(topic) ? nullptr : messageOf<nav_msgs::OccupancyGrid>(message)) {
    map_.publish(map);
  }
}

void BagReplayPlayer::publishPose(const nav_msgs::Odometry& odometry) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(
      toMessage(fromMessage(odometry.pose.pose), drive_.odometry_frame, drive_.base_frame, odometry.header.stamp));
  transforms_.publish(transforms);
}

/// The node `bag_replay`: plays a recording with /clock, scan, odom and tf, and shows what the planner would have
/// decided at each step beside what the driver did.
///
/// All is decided before anything is played, from the stamps of the recording, so neither the rate nor the load of the
/// computer has a say in it. Topics: those of DecisionDisplay.
class BagReplay {
 public:
  /// Reads the recording and decides. Throws std::invalid_argument when that cannot be done.
  explicit BagReplay(const BagReplayParameters& parameters);

  /// Plays it to the end, or until the node is shut down, and logs how often planner and driver agreed.
  void run();

 private:
  void waitForListeners() const;
  void showDecisionsUntil(const ros::Time& time);

  BagReplayParameters parameters_;
  DecisionReplay replay_;
  BagDriveResult drive_;
  BagReplayPlayer player_;
  std::size_t shown_ = 0;  ///< decisions

  DecisionDisplay display_;
};

BagReplay::BagReplay(const BagReplayParameters& parameters)
    : parameters_(parameters),
      replay_(DrivePolicy::fromFile(resolvedPath(parameters.planner.model)), parameters.planner.agent,
              parameters.planner.sensors.scan_rules),
      drive_(recordBags(
          {parameters.bag}, parameters.drive,
          replayParameters(replay_.description(), parameters.planner.agent, parameters.planner.sensors.scan_rules),
          &replay_)),
      player_(parameters.bag, drive_),
      display_(replay_.description()) {
  if (replay_.decisions().empty()) {
    throw std::invalid_argument("there is no step to decide about in '" + parameters_.bag +
                                "': " + describeReplay(replay_));
  }
  if (parameters_.drive.mount) player_.placeScanner(*parameters_.drive.mount);
  if (parameters_.decisions.empty()) return;
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
  const ros::SteadyTime given_up = ros::SteadyTime::now() + ros::WallDuration(parameters_.patience);
  while (ros::ok() && ros::SteadyTime::now() < given_up) {
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

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
BagReplayParameters loadBagReplayParameters(const ros::NodeHandle& private_node) {
  BagReplayParameters parameters;
  ParameterReader reader(private_node);
  visitBagReplayParameters(parameters, reader.visitor());
  if (reader.isSet("mount")) reader.read("mount", &parameters.drive.mount.emplace().pose);
  reader.knowRobotFile();
  reader.warnOfUnknown();
  parameters.planner = loadGlobalPlannerParameters(ros::NodeHandle(private_node, "LstmGlobalPlanner"));
  if (parameters.bag.empty()) {
    throw std::invalid_argument("parameter " + private_node.resolveName("bag") +
                                " is empty, expected the path of a bag");
  }
  parameters.bag = resolvedPath(parameters.bag);
  parameters.decisions = resolvedPath(parameters.decisions);
  return parameters;
}

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  using namespace lstm_planner;
  return runNode(argc, argv, "bag_replay", [](const ros::NodeHandle& node) {
    BagReplay(loadBagReplayParameters(node)).run();
    return 0;
  });
}
