#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/dataset/hindsight.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// What a bag does not say itself.
struct BagDriveOptions {
  std::string scan_topic;                ///< empty: the bag's only topic of scans
  std::string odometry_topic;            ///< empty: the bag's only topic of odometry; where there is none, from tf
  std::string odometry_frame = "odom";   ///< for odometry from tf
  std::string base_frame = "base_link";  ///< where the odometry does not name it, and for odometry from tf
  std::optional<SensorMount> mount;      ///< where the scanner sits; empty: from tf
  std::vector<std::string> goal_topics;  ///< PoseStamped or MoveBaseActionGoal; empty: move_base/goal,
                                         ///< move_base_simple/goal and dataset_recorder/goal
  bool hindsight = false;                ///< goals are places the driver went to, not the bag's
  HindsightParameters hindsight_parameters;
};

/// What was made of a bag.
struct BagDriveResult {
  long scans = 0;
  long odometry = 0;
  long goals = 0;         ///< heard, or found in hindsight
  double start = 0.0;     ///< s since 1970, by the clock of the computer that recorded
  double duration = 0.0;  ///< s
  std::string scan_topic;
  std::string odometry_source;  ///< a topic, or "tf"
  std::string odometry_frame;
  std::string base_frame;  ///< the robot's, as the odometry names it, or else that of the options
  std::string scan_frame;
  std::string transforms;         ///< topic; empty: there are none
  std::string static_transforms;  ///< topic; empty: there are none
  /// ns, the recording computer's clock less the sensors', if the message that was on its way for the shortest time
  /// took none; empty: nothing has a stamp.
  std::optional<std::int64_t> clock_difference;
  std::vector<std::string> goal_topics;  ///< those of the bag that were listened to
  long skipped = 0;                      ///< messages that are broken or have a stamp far ahead of the others
  std::string first_skipped;             ///< topic, time and why
};

/// The bags that are parts of one recording (rosbag record --split), in the order of their times.
using BagParts = std::vector<std::string>;

/// The recordings among bags and folders of bags (files *.bag, without their folders), each file once: bags that begin
/// within `max_gap` (s) of the end of another one go on with it. In the order of their times; a bag that cannot be
/// read, or is empty, stands alone at the end. Throws std::invalid_argument for a folder without a bag.
std::vector<BagParts> bagRecordings(const std::vector<std::string>& paths, double max_gap);

/// Replays a recording into a recorder, in the order and with the clock of its messages: the steps are those that the
/// node dataset_recorder would have made of them. The parts are one timeline: goals and static transforms of one hold
/// in those behind it. Beside goals move_base's cancel and result are heard, and tf: tf and tf_static, also of the
/// old type tf/tfMessage. Each of these names is looked for in the namespace of the scans, and then in those around
/// it. Where the stamps of transforms go back by more than max_gap, the older ones are forgotten, as tf does when the
/// node's clock goes back. Needs no master, nor ros::init().
///
/// Odometry from tf has a message for each transform of `odometry_frame`, and the speeds between them. Goals in
/// hindsight are found in what the recorder would hear of the odometry: see hindsightGoals().
///
/// Throws std::invalid_argument, naming the bags and what was expected, when one cannot be read, or they have no scans,
/// no odometry, several topics to choose from, no goals, two runs with the same times (mixedRuns()), or neither options
/// nor transforms say where the scanner sits; `sink` has not been told anything then.
BagDriveResult recordBags(const BagParts& parts, const BagDriveOptions& options, const RecorderParameters& parameters,
                          StepSink* sink);

}  // namespace lstm_planner
