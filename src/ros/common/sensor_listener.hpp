#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/message_event.h>
#include <ros/subscriber.h>
#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>

#include <mutex>
#include <optional>
#include <string>

#include "lstm_planner/drive/perception/beam_times_watch.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/odometry_history.hpp"
#include "lstm_planner/drive/perception/period_meter.hpp"
#include "lstm_planner/drive/perception/scanner_watch.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/drive/plugin_parameters.hpp"
#include "lstm_planner/ros/common/publisher_watch.hpp"
#include "lstm_planner/ros/common/scanner_mounts.hpp"
#include "ros/common/message_queue.hpp"
#include "ros/common/odometry_base.hpp"

namespace lstm_planner {

/// The newest scan of a scanner.
struct ScanReading {
  LaserScan scan;      ///< as if all beams had been measured at the stamp: see deskew()
  double stamp = 0.0;  ///< s; when it was received, where the driver does not stamp its scans
  SensorMount mount;   ///< of the scanner in the base frame
  Pose2 pose;          ///< base in the odometry frame when the scan was taken
};

/// What the sensors say at one moment.
struct SensorReading {
  ScanReading first;
  std::optional<ScanReading> second;  ///< of the second scanner, where there is one
  double scan_period = 0.0;           ///< s, the longer one, as measured; 0 as long as it is not known
  std::string odometry_frame;
  double odometry_stamp = 0.0;  ///< s, of the newest odometry
  Pose2 newest_pose;  ///< base in the odometry frame, by the newest odometry, or when the first scan was taken if later
  Twist2 twist;       ///< newest, base frame; by the poses where the messages' twist contradicts them
  long jumps = 0;     ///< how often the odometry has jumped so far
};

/// Fills a situation with what the scanners of a reading see. `from_odometry`: the odometry frame in the situation's.
/// Throws as perceive() of one scan and perceiveSecond().
void perceive(const SensorReading& reading, const Pose2& from_odometry, const ScanRules& rules, double range_cap,
              Situation* situation);

/// How a sensor's messages come.
struct SensorHealth {
  std::string topic;
  double age = 0.0;     ///< s, of the newest message; negative: stamped in the future
  double period = 0.0;  ///< s, as measured; 0 as long as it is not known
  double timeout = 0.0;
  std::string problem;              ///< what is wrong with the newest one's age; empty when nothing is
  bool is_heard = false;            ///< something has come
  bool contradicts_itself = false;  ///< an odometry whose twist is not believed
};

/// Keeps the newest scan of one scanner or two, and the odometry around it. Never waits for any. Thread safe.
class SensorListener {
 public:
  /// `base_frame` is the robot's, whichever part of it the odometry is of. `messages` and `tf` must outlive the
  /// object.
  SensorListener(MessageQueue* messages, const SensorParameters& parameters, const std::string& base_frame,
                 const tf2_ros::Buffer& tf);

  /// Of what has come until now. Throws SensorError when a scan or odometry is missing, too old, not finite, a scanner
  /// is covered (SilenceWatch) or its place is not known.
  SensorReading read(const ros::Time& now);

  /// Base in the odometry frame, newest, however old; none before the first odometry.
  std::optional<Pose2> newestPose();

  bool hasSecondScanner() const { return second_.has_value(); }
  SensorHealth scanHealth(const ros::Time& now);
  SensorHealth secondScanHealth(const ros::Time& now);  ///< only where there is one
  SensorHealth odometryHealth(const ros::Time& now);

 private:
  using ScanEvent = ros::MessageEvent<sensor_msgs::LaserScan const>;
  /// A scanner, and what it saw last.
  struct Scanner {
    explicit Scanner(const ScannerWatch& scanner_watch) : watch(scanner_watch) {}
    ScannerWatch watch;
    PublisherWatch publishers;
    BeamTimesWatch beam_times;
    LaserScan scan;
    std::string frame;
  };

  void onScan(const ScanEvent& event) { hear(event, &first_); }
  void onSecondScan(const ScanEvent& event) { hear(event, &*second_); }
  void hear(const ScanEvent& event, Scanner* scanner);
  void onOdometry(const ros::MessageEvent<nav_msgs::Odometry const>& event);
  std::string odometryProblem(const ros::Time& now) const;
  void checkOdometry(const ros::Time& now) const;
  void sayContradictions(const sensor_msgs::LaserScan& scan, const std::string& topic) const;
  void sayContradictions(const nav_msgs::Odometry& odometry) const;
  void sayTimeoutsOnce();
  double odometryTimeout() const;
  ScannerWatch watchFor(const std::string& topic) const;
  ScanReading readingOf(Scanner* scanner);
  ScanRules rulesFor(const ScanReading& reading, Scanner* scanner) const;
  SensorHealth healthOf(const Scanner& scanner, const ros::Time& now);
  const SensorMount& mountOf(const Scanner& scanner);

  MessageQueue& messages_;
  SensorParameters parameters_;
  std::string base_frame_;
  std::string odometry_topic_;  ///< with its namespace; a subscriber may call back before it can be asked

  std::mutex mutex_;  ///< guards all below
  ScannerMounts mounts_;
  OdometryBase odometry_base_;
  std::string odometry_frame_;
  ros::Time odometry_stamp_;
  ros::Time odometry_received_;
  PeriodMeter odometry_period_;
  PublisherWatch odometry_publishers_;
  bool timeouts_are_said_ = false;
  bool odometry_is_finite_ = true;
  OdometryHistory history_;

  Scanner first_;
  std::optional<Scanner> second_;

  ros::Subscriber scan_subscriber_;
  ros::Subscriber second_scan_subscriber_;
  ros::Subscriber odometry_subscriber_;
};

}  // namespace lstm_planner
