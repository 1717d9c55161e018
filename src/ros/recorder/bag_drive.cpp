#include "lstm_planner/ros/recorder/bag_drive.hpp"

#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <move_base_msgs/MoveBaseActionResult.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/exceptions.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/predicate.hpp>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>

#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/dataset/drive_events.hpp"
#include "lstm_planner/dataset/mixed_runs.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/recorder/drive_messages.hpp"
#include "ros/recorder/bag_message.hpp"
#include "ros/recorder/bag_topics.hpp"
#include "ros/recorder/stamp_check.hpp"

namespace lstm_planner {
namespace {

/// Makes odometry of the transforms between odometry frame and base.
class OdometryFromTransforms {
 public:
  OdometryFromTransforms(const std::string& odometry_frame, const std::string& base_frame);

  /// `heard`: what `tf` has just been told. Empty when that tells nothing new of the base in the odometry frame.
  std::optional<nav_msgs::Odometry> of(const geometry_msgs::TransformStamped& heard, const tf2::BufferCore& tf);

 private:
  void setTwist(nav_msgs::Odometry* odometry) const;

  std::string odometry_frame_;
  std::string base_frame_;
  ros::Time newest_;  ///< of the transforms of the odometry frame: what leads on to the base may be told later
  nav_msgs::Odometry last_;
};

OdometryFromTransforms::OdometryFromTransforms(const std::string& odometry_frame, const std::string& base_frame)
    : odometry_frame_(frameName(odometry_frame)), base_frame_(frameName(base_frame)) {}

std::optional<nav_msgs::Odometry> OdometryFromTransforms::of(const geometry_msgs::TransformStamped& heard,
                                                             const tf2::BufferCore& tf) {
  if (frameName(heard.header.frame_id) == odometry_frame_) newest_ = heard.header.stamp;
  if (newest_ == last_.header.stamp || !tf.canTransform(odometry_frame_, base_frame_, newest_)) return std::nullopt;
  const geometry_msgs::Transform transform = tf.lookupTransform(odometry_frame_, base_frame_, newest_).transform;
  nav_msgs::Odometry odometry;
  odometry.header.stamp = newest_;
  odometry.header.frame_id = odometry_frame_;
  odometry.child_frame_id = base_frame_;
  odometry.pose.pose = toMessage(fromMessage(transform));
  setTwist(&odometry);
  last_ = odometry;
  return odometry;
}

void OdometryFromTransforms::setTwist(nav_msgs::Odometry* odometry) const {
  if (last_.header.stamp.isZero()) return;  // ros::Duration ends at 68 years
  const double elapsed = (odometry->header.stamp - last_.header.stamp).toSec();
  if (elapsed <= 0.0) return;
  const Pose2 before = fromMessage(last_.pose.pose);
  const Pose2 pose = fromMessage(odometry->pose.pose);
  odometry->twist.twist.linear.x = toLocalFrame(before, {pose.x, pose.y}).x / elapsed;
  odometry->twist.twist.angular.z = normalizeAngle(pose.yaw - before.yaw) / elapsed;
}

using OpenBags = std::vector<std::unique_ptr<rosbag::Bag>>;

/// rosbag's own exceptions tell little of a file that is none of its own.
void checkIsBag(const std::string& path) {
  checkInputFile(path, std::numeric_limits<std::uintmax_t>::max());
  std::ifstream file(path, std::ios::binary);
  std::array<char, 16> start{};
  file.read(start.data(), start.size());
  const std::string begin(start.data(), static_cast<std::size_t>(file.gcount()));
  if (begin.empty()) throw InputFileError("it is empty, as when recording was cut off before anything was written");
  if (begin.find("SQLite format 3") == 0 || begin.find("MCAP") == 1) {
    throw InputFileError("it is a recording of ROS 2, expected a bag of ROS 1: rosbags-convert makes one of it");
  }
  if (begin.find("#ROS") != 0) throw InputFileError("it does not begin with #ROSBAG, expected a bag of ROS 1");
}

std::unique_ptr<rosbag::Bag> openBag(const std::string& path) {
  checkIsBag(path);
  return std::make_unique<rosbag::Bag>(path, rosbag::bagmode::Read);
}

/// What hears a bag's messages.
class BagListener {
 public:
  virtual ~BagListener() = default;
  virtual void hear(const sensor_msgs::LaserScan& scan, const ros::Time& received) = 0;
  virtual void hear(const nav_msgs::Odometry& odometry, const ros::Time& received) = 0;
  virtual void hearGoal(const rosbag::MessageInstance& message) = 0;
  virtual void hearEnd(const rosbag::MessageInstance& message) = 0;
};

/// Plays the messages of a recording, as often as is wanted.
class BagPlayer {
 public:
  /// `max_gap`: s, RecorderParameters::max_gap.
  BagPlayer(const OpenBags& bags, const BagDriveOptions& options, double max_gap)
      : options_(options), bags_(bags), max_gap_(max_gap) {
    rosbag::View view;
    for (const auto& bag : bags_) view.addQuery(*bag);
    topics_ = chooseTopics(&view, options);
  }

  const BagTopics& topics() const { return topics_; }

  /// `tf` is told the transforms before the messages behind them are heard.
  void play(tf2::BufferCore* tf, BagListener* listener) {
    OdometryFromTransforms odometry(options_.odometry_frame, options_.base_frame);
    stamps_ = StampCheck();
    newest_transforms_.clear();
    skipped_ = 0;
    rosbag::View view;
    for (const auto& bag : bags_) view.addQuery(*bag, rosbag::TopicQuery(topics_.all()));
    for (const rosbag::MessageInstance& message : view) {
      try {
        play(message, tf, &odometry, listener);
      } catch (const rosbag::BagException&) {
        throw;  // the file is damaged, not the message
      } catch (const std::exception& error) {
        skip(message, error.what());
      }
    }
  }

  /// Messages that the last play() could not use, and why the first.
  long skipped() const { return skipped_; }
  const std::string& firstSkipped() const { return first_skipped_; }

 private:
  void play(const rosbag::MessageInstance& message, tf2::BufferCore* tf, OdometryFromTransforms* odometry,
            BagListener* listener) {
    const std::string topic = message.getTopic();
    if (topic == topics_.scan) {
      const auto scan = messageOf<sensor_msgs::LaserScan>(message);
      if (scan && isPlausible(*scan, message)) listener->hear(*scan, message.getTime());
    } else if (topic == topics_.odometry) {
      const auto heard = messageOf<nav_msgs::Odometry>(message);
      if (heard && isPlausible(*heard, message)) listener->hear(*heard, message.getTime());
    } else if (topic == topics_.transforms || topic == topics_.static_transforms) {
      playTransforms(message, tf, odometry, listener);
    } else if (contains(topics_.goals, topic)) {
      listener->hearGoal(message);
    } else {
      listener->hearEnd(message);
    }
  }

  void playTransforms(const rosbag::MessageInstance& message, tf2::BufferCore* tf, OdometryFromTransforms* odometry,
                      BagListener* listener) {
    const auto transforms = messageOf<tf2_msgs::TFMessage>(message);
    if (!transforms) return;
    const bool is_static = message.getTopic() == topics_.static_transforms;
    std::vector<geometry_msgs::TransformStamped> plausible;
    for (const geometry_msgs::TransformStamped& transform : transforms->transforms) {
      if (!is_static && !isPlausible(transform, message)) continue;
      if (!is_static && wasClockSetBack(transform)) tf->clear();  // static transforms stay
      tf->setTransform(transform, "bag", is_static);
      plausible.push_back(transform);
    }
    if (!topics_.odometry.empty()) return;
    for (const geometry_msgs::TransformStamped& transform : plausible) {
      const std::optional<nav_msgs::Odometry> heard = odometry->of(transform, *tf);
      if (heard) listener->hear(*heard, message.getTime());
    }
  }

  /// The clock by which transforms are stamped. tf takes older stamps for late messages, which it drops, or mixes with
  /// those of the same time.
  bool wasClockSetBack(const geometry_msgs::TransformStamped& transform) {
    const double stamp = transform.header.stamp.toSec();
    double& newest = newest_transforms_.try_emplace(transform.child_frame_id, stamp).first->second;
    const bool was_set_back = stamp < newest - max_gap_;
    newest = was_set_back ? stamp : std::max(newest, stamp);
    return was_set_back;
  }

  template <typename Stamped>
  bool isPlausible(const Stamped& stamped, const rosbag::MessageInstance& message) {
    const double stamp = stamped.header.stamp.toSec();
    if (stamps_.isPlausible(stamp, message.getTime().toSec())) return true;
    skip(message, "it has a stamp of " + fixedText(stamp, 3) + " s, far ahead of the others");
    return false;
  }

  void skip(const rosbag::MessageInstance& message, const std::string& why) {
    if (++skipped_ > 1) return;
    first_skipped_ = message.getTopic() + " at " + fixedText(message.getTime().toSec(), 3) + " s: " + why;
  }

  const BagDriveOptions& options_;
  const OpenBags& bags_;
  double max_gap_;
  BagTopics topics_;
  StampCheck stamps_;
  std::map<std::string, double> newest_transforms_;  ///< s, by child frame: each publisher has a clock of its own
  long skipped_ = 0;
  std::string first_skipped_;
};

/// Finds out what a bag holds before anything is recorded.
class Survey : public BagListener {
 public:
  Survey(const BagDriveOptions& options, const RecorderParameters& parameters)
      : stand_in_(frameName(options.base_frame)), order_(parameters.delay, parameters.max_gap) {
    result.base_frame = stand_in_;
  }

  void hear(const sensor_msgs::LaserScan& scan, const ros::Time& received) override {
    note(received);
    noteClock(scan.header.stamp, received);
    ++result.scans;
    result.scan_frame = frameName(scan.header.frame_id);
  }

  void hear(const nav_msgs::Odometry& odometry, const ros::Time& received) override {
    note(received);
    noteClock(odometry.header.stamp, received);
    ++result.odometry;
    result.odometry_frame = frameName(odometry.header.frame_id);
    const std::string robot_frame = robotFrameOf(odometry);
    if (!robot_frame.empty()) result.base_frame = robot_frame;
    const OdometryHeard heard{stampOr(odometry.header.stamp, received).toSec(), fromMessage(odometry.pose.pose), {}};
    if (isFinite(heard.pose)) put(heard);
  }

  void hearGoal(const rosbag::MessageInstance& message) override {
    note(message.getTime());
    ++result.goals;
  }

  void hearEnd(const rosbag::MessageInstance& message) override { note(message.getTime()); }

  /// The odometry as a recorder works on it.
  std::vector<OdometryHeard> takePath() {
    takeFromOrder(true);
    return std::move(path_);
  }

  /// A guess would make steps that look right and are wrong.
  void requireMount(const tf2::BufferCore& tf) {
    if (result.scan_frame.empty()) {
      throw std::invalid_argument(
          "has scans without a frame, expected one in header.frame_id, or the scanner's pose as "
          "--mount");
    }
    // As ScannerMounts.
    const bool stands_in =
        !tf._frameExists(result.base_frame) && tf.canTransform(stand_in_, result.scan_frame, ros::Time(0));
    if (stands_in) result.base_frame = stand_in_;
    if (result.scan_frame == result.base_frame || tf.canTransform(result.base_frame, result.scan_frame, ros::Time(0)))
      return;
    throw std::invalid_argument(
        "has no transform from " + result.base_frame + " to the scanner's frame " + result.scan_frame +
        ": expected it on /tf_static or /tf, in this part or, if the recording was split, in one "
        "that is given with it, or the scanner's pose as --mount");
  }

  BagDriveResult result;

 private:
  void note(const ros::Time& received) {
    if (result.start == 0.0) result.start = received.toSec();
    result.duration = std::max(result.duration, received.toSec() - result.start);
  }

  void noteClock(const ros::Time& stamp, const ros::Time& received) {
    if (stamp.isZero()) return;
    const auto difference = static_cast<std::int64_t>(received.toNSec()) - static_cast<std::int64_t>(stamp.toNSec());
    result.clock_difference = std::min(difference, result.clock_difference.value_or(difference));
  }

  void put(const OdometryHeard& heard) {
    if (order_.add(heard) == EventOrder::Verdict::kClockSet) {
      takeFromOrder(true);
      order_.clear();
      order_.add(heard);
    }
    takeFromOrder(false);
  }

  void takeFromOrder(bool all) {
    while (const std::optional<DriveEvent> event = order_.take(all)) path_.push_back(std::get<OdometryHeard>(*event));
  }

  std::string stand_in_;  ///< where the odometry does not name the robot's frame, or not as tf does
  EventOrder order_;
  std::vector<OdometryHeard> path_;
};

/// Gives a bag to a recorder.
class Recorder : public BagListener {
 public:
  Recorder(const tf2::BufferCore& tf, const BagDriveOptions& options, const std::optional<SensorMount>& mount,
           const RecorderParameters& parameters, std::vector<DriveEvent> hindsight_goals, StepSink* sink)
      : messages_(tf, options.base_frame, mount, parameters, sink),
        goals_(std::move(hindsight_goals), parameters.max_gap) {}

  void hear(const sensor_msgs::LaserScan& scan, const ros::Time& received) override { messages_.hear(scan, received); }

  void hear(const nav_msgs::Odometry& odometry, const ros::Time& received) override {
    messages_.hear(odometry, received);
    goals_.tell(stampOr(odometry.header.stamp, received).toSec(), &messages_.recorder());
  }

  void hearGoal(const rosbag::MessageInstance& message) override {
    const std::string topic = absoluteTopic(message.getTopic()).substr(1);
    // As the node itself calls the goals that it publishes there.
    const std::string source = boost::algorithm::ends_with(topic, "dataset_recorder/goal") ? "waypoints" : topic;
    if (const auto goal = messageOf<geometry_msgs::PoseStamped>(message)) {
      messages_.hearGoal(*goal, source, message.getTime());
    } else if (const auto action = messageOf<move_base_msgs::MoveBaseActionGoal>(message)) {
      messages_.hear(*action, source, message.getTime());
    }
  }

  void hearEnd(const rosbag::MessageInstance& message) override {
    if (const auto cancel = messageOf<actionlib_msgs::GoalID>(message)) {
      messages_.hear(*cancel, message.getTime());
    } else if (const auto result = messageOf<move_base_msgs::MoveBaseActionResult>(message)) {
      messages_.hear(*result, message.getTime());
    }
  }

  void finish() { messages_.recorder().finish(); }

 private:
  DriveMessages messages_;
  GoalSchedule goals_;
};

void checkContent(const BagDriveResult& result, const BagDriveOptions& options) {
  if (result.scans == 0) throw std::invalid_argument("has no messages on " + result.scan_topic);
  if (result.odometry == 0) {
    throw std::invalid_argument("has no odometry: expected " +
                                (result.odometry_source == "tf"
                                     ? "a topic of nav_msgs/Odometry, or the transforms from " +
                                           options.odometry_frame + " to " + options.base_frame +
                                           " (--odometry-frame, --base-frame)"
                                     : "messages on " + result.odometry_source));
  }
  if (!options.hindsight && result.odometry_frame.empty()) {
    throw std::invalid_argument("has odometry without a frame, expected one in header.frame_id on " +
                                result.odometry_source + ": only goals in hindsight need none");
  }
  if (!options.hindsight && result.goals == 0) {
    throw std::invalid_argument(
        "has no goals: expected some on move_base/goal, move_base_simple/goal or another --goal-topic; with "
        "--hindsight places that the robot reached are the goals");
  }
}

void checkIsOneRun(const std::vector<OdometryHeard>& path, double max_speed) {
  const auto mixed = mixedRuns(path, max_speed);
  if (!mixed) return;
  throw std::invalid_argument(
      "has two runs with the same times: its odometry jumps to and fro between two paths from " +
      fixedText(mixed->first, 3) + " s to " + fixedText(mixed->second, 3) +
      " s. The clock was set back while it was recorded, as when a simulator starts again: record one bag a run");
}

BagDriveResult record(const OpenBags& bags, const BagDriveOptions& options, const RecorderParameters& parameters,
                      StepSink* sink) {
  BagPlayer player(bags, options, parameters.max_gap);
  Survey survey(options, parameters);
  tf2::BufferCore all_transforms;
  player.play(&all_transforms, &survey);
  BagDriveResult& result = survey.result;
  result.scan_topic = player.topics().scan;
  result.odometry_source = player.topics().odometry.empty() ? "tf" : player.topics().odometry;
  result.transforms = player.topics().transforms;
  result.static_transforms = player.topics().static_transforms;
  result.goal_topics = player.topics().goals;
  checkContent(result, options);
  const std::vector<OdometryHeard> path = survey.takePath();
  checkIsOneRun(path, parameters.max_speed);
  if (!options.mount) survey.requireMount(all_transforms);

  std::vector<DriveEvent> goals;
  if (options.hindsight) {
    goals = hindsightGoals(path, options.hindsight_parameters, parameters, result.odometry_frame);
    result.goals = std::count_if(goals.begin(), goals.end(),
                                 [](const DriveEvent& event) { return std::holds_alternative<GoalHeard>(event); });
  }
  tf2::BufferCore tf;
  Recorder recorder(tf, options, options.mount, parameters, std::move(goals), sink);
  player.play(&tf, &recorder);
  recorder.finish();
  result.skipped = player.skipped();
  result.first_skipped = player.firstSkipped();
  return result;
}

/// What `work` returns; what it throws becomes a sentence that begins with the bag's name.
template <typename Work>
auto naming(const std::string& bag, const Work& work) {
  try {
    return work();
  } catch (const rosbag::BagUnindexedException&) {
    throw std::invalid_argument(bag + ": has no index, as when recording was cut off: rosbag reindex makes one");
  } catch (const ros::Exception& error) {
    throw std::invalid_argument(bag + ": cannot be read: " + error.what());
  } catch (const InputFileError& error) {
    throw std::invalid_argument(bag + ": cannot be read: " + error.what());
  } catch (const std::bad_alloc&) {
    throw std::invalid_argument(bag + ": cannot be read: it is damaged");
  } catch (const std::exception& error) {
    throw std::invalid_argument(bag + ": " + error.what());
  }
}

std::string nameOf(const BagParts& parts) {
  std::string name = parts.size() == 1 ? "the bag " : "the bags ";
  for (const std::string& part : parts) name += (&part == &parts.front() ? "" : ", ") + part;
  return name;
}

}  // namespace

BagDriveResult recordBags(const BagParts& parts, const BagDriveOptions& options, const RecorderParameters& parameters,
                          StepSink* sink) {
  validate(parameters);
  OpenBags bags;
  for (const std::string& part : parts) {
    bags.push_back(naming(nameOf({part}), [&] { return openBag(part); }));
  }
  return naming(nameOf(parts), [&] { return record(bags, options, parameters, sink); });
}

}  // namespace lstm_planner
