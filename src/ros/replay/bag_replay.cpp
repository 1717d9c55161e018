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
#include <functional>
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

namespace lstm_planner {
namespace {

const ros::WallDuration kSettling(0.5);  // within which a computer that is not too busy makes and serves connections
constexpr int kQueue = 1000;             // what is played as fast as possible comes faster than it is sent

/// Plays the scans, odometry, transforms and map of a bag on /clock, scan, odom, /tf, /tf_static and map.
///
/// The clock is the sensors': the recording computer's may differ from theirs, so the message that was on its way for
/// the shortest time is taken to have arrived at its stamp. Where the bag has no transforms of its own, the robot's
/// pose comes from the odometry.
class BagReplayPlayer {
 public:
  /// What of the bag is played; empty what it does not have.
  struct Topics {
    std::string scan;
    std::string odometry;
    std::string transforms;
    std::string static_transforms;
  };

  /// Of a bag that recordBags() has read.
  BagReplayPlayer(const std::string& path, const Topics& topics);

  /// The robot's, as the odometry names it; empty where it does not.
  const std::string& baseFrame() const { return base_frame_; }

  /// Tells viewers where the scanner sits, for bags that do not.
  void placeScanner(const SensorMount& mount, const std::string& base_frame);

  /// `rate`: s of the recording in a second, 0 = as fast as possible. `at` is called with the time of the recording
  /// before each of its messages. Ends early when the node is shut down.
  void play(double rate, const std::function<void(const ros::Time&)>& at);

 private:
  void readClock();
  void waitUntil(const ros::Time& time, double rate);
  void tellTime(const ros::Time& time);
  void publish(const rosbag::MessageInstance& message);
  void publishPose(const nav_msgs::Odometry& odometry);

  rosbag::Bag bag_;
  Topics topics_;
  ros::Duration clock_difference_{ros::DURATION_MAX};  ///< recording computer's less the sensors'
  std::string odometry_frame_;
  std::string base_frame_;
  std::string scan_frame_;
  ros::NodeHandle node_;
  ros::Publisher clock_;
  ros::Publisher scans_;
  ros::Publisher odometry_;
  ros::Publisher transforms_;
  ros::Publisher map_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  std::optional<ros::Time> began_;  ///< of the recording
  ros::WallTime wall_began_;
};

BagReplayPlayer::BagReplayPlayer(const std::string& path, const Topics& topics)
    : topics_(topics),
      clock_(node_.advertise<rosgraph_msgs::Clock>("/clock", kQueue)),
      scans_(node_.advertise<sensor_msgs::LaserScan>("scan", kQueue)),
      odometry_(node_.advertise<nav_msgs::Odometry>("odom", kQueue)),
      transforms_(node_.advertise<tf2_msgs::TFMessage>("/tf", kQueue)),
      map_(node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true)) {
  bag_.open(path);
  readClock();
}

void BagReplayPlayer::readClock() {
  rosbag::View sensors(bag_, rosbag::TopicQuery(std::vector<std::string>{topics_.scan, topics_.odometry}));
  for (const rosbag::MessageInstance& message : sensors) {
    std_msgs::Header header;
    if (const auto scan = messageOf<sensor_msgs::LaserScan>(message)) {
      header = scan->header;
      if (scan_frame_.empty()) scan_frame_ = frameName(header.frame_id);
    } else if (const auto odometry = messageOf<nav_msgs::Odometry>(message)) {
      header = odometry->header;
      if (odometry_frame_.empty()) odometry_frame_ = frameName(header.frame_id);
      if (base_frame_.empty()) base_frame_ = robotFrameOf(*odometry);
    }
    if (!header.stamp.isZero()) {
      clock_difference_ = std::min(clock_difference_, message.getTime() - header.stamp);
    }
  }
  if (clock_difference_ == ros::DURATION_MAX) {
    clock_difference_ = ros::Duration(0.0);
  }
}

void BagReplayPlayer::placeScanner(const SensorMount& mount, const std::string& base_frame) {
  static_transforms_.sendTransform(mountToMessage(mount, base_frame, scan_frame_));
}

void BagReplayPlayer::play(double rate, const std::function<void(const ros::Time&)>& at) {
  rosbag::View view(bag_);
  began_.reset();
  for (const rosbag::MessageInstance& message : view) {
    if (!ros::ok()) {
      return;
    }
    const ros::Time time = message.getTime() - clock_difference_;
    waitUntil(time, rate);
    tellTime(time);
    at(time);
    publish(message);
  }
}

void BagReplayPlayer::waitUntil(const ros::Time& time, double rate) {
  constexpr double kClockPeriod = 0.02;  // s of the computer's, also where the recording is silent
  if (!began_) {
    began_ = time;
    wall_began_ = ros::WallTime::now();
  }
  if (rate <= 0.0) {
    return;
  }
  const ros::WallTime due = wall_began_ + ros::WallDuration((time - *began_).toSec() / rate);
  for (ros::WallTime now = ros::WallTime::now(); now < due && ros::ok(); now = ros::WallTime::now()) {
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
  const std::string& topic = message.getTopic();
  if (topic == topics_.scan) {
    if (const auto scan = messageOf<sensor_msgs::LaserScan>(message)) scans_.publish(scan);
  } else if (topic == topics_.odometry) {
    const auto odometry = messageOf<nav_msgs::Odometry>(message);
    if (!odometry) return;
    odometry_.publish(odometry);
    if (topics_.transforms.empty()) publishPose(*odometry);
  } else if (topic == topics_.transforms) {
    if (const auto transforms = messageOf<tf2_msgs::TFMessage>(message)) transforms_.publish(transforms);
  } else if (topic == topics_.static_transforms) {
    const auto transforms = messageOf<tf2_msgs::TFMessage>(message);
    if (transforms) static_transforms_.sendTransform(transforms->transforms);
  } else if (const auto map = messageOf<nav_msgs::OccupancyGrid>(message)) {
    map_.publish(map);
  }
}

void BagReplayPlayer::publishPose(const nav_msgs::Odometry& odometry) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(
      toMessage(fromMessage(odometry.pose.pose), odometry_frame_, base_frame_, odometry.header.stamp));
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
      player_(parameters.bag, {drive_.scan_topic, drive_.odometry_source == "tf" ? "" : drive_.odometry_source,
                               drive_.transforms, drive_.static_transforms}),
      display_(replay_.description()) {
  if (replay_.decisions().empty()) {
    throw std::invalid_argument("there is no step to decide about in '" + parameters_.bag +
                                "': " + describeReplay(replay_));
  }
  if (parameters_.drive.mount) {
    player_.placeScanner(*parameters_.drive.mount,
                         player_.baseFrame().empty() ? parameters_.drive.base_frame : player_.baseFrame());
  }
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
