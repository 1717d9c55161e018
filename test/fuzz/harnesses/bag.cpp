#include <actionlib_msgs/GoalID.h>
#include <console_bridge/console.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <move_base_msgs/MoveBaseActionResult.h>
#include <nav_msgs/Odometry.h>
#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz/fuzz_scan.hpp"
#include "fuzz/harness.hpp"
#include "fuzz/scratch_file.hpp"
#include "fuzz/small_memory.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/ros/recorder/bag_drive.hpp"

namespace lstm_planner::fuzz {

/// Any bytes that call themselves a message of some type.
struct RawMessage {
  std::string md5sum;
  std::string type;
  std::string definition;
  std::vector<std::uint8_t> bytes;
};

}  // namespace lstm_planner::fuzz

namespace ros {
namespace message_traits {
template <>
struct MD5Sum<lstm_planner::fuzz::RawMessage> {
  static const char* value(const lstm_planner::fuzz::RawMessage& message) { return message.md5sum.c_str(); }
};
template <>
struct DataType<lstm_planner::fuzz::RawMessage> {
  static const char* value(const lstm_planner::fuzz::RawMessage& message) { return message.type.c_str(); }
};
template <>
struct Definition<lstm_planner::fuzz::RawMessage> {
  static const char* value(const lstm_planner::fuzz::RawMessage& message) { return message.definition.c_str(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<lstm_planner::fuzz::RawMessage> {
  template <typename Stream>
  static void write(Stream& stream, const lstm_planner::fuzz::RawMessage& message) {
    std::copy(message.bytes.begin(), message.bytes.end(),
              stream.advance(static_cast<std::uint32_t>(message.bytes.size())));
  }
  static std::uint32_t serializedLength(const lstm_planner::fuzz::RawMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};
}  // namespace serialization
}  // namespace ros

namespace lstm_planner::fuzz::bag_harness {
namespace {

/// Writes the messages of a drive, some with other fields or other bytes.
class BagMaker {
 public:
  BagMaker(const std::string& path, FuzzInput* input) : input_(*input), bag_(writer()) {
    bag_.open(path, rosbag::bagmode::Write);
  }
  ~BagMaker() { bag_.close(); }
  BagMaker(const BagMaker&) = delete;
  BagMaker& operator=(const BagMaker&) = delete;

  void make() {
    constexpr int kMostMessages = 60;
    writeMount();
    for (int i = 0; i < kMostMessages && !input_.empty(); ++i) {
      time_ += input_.byte() / 512.0;
      writeMessage();
    }
  }

 private:
  /// One for many inputs: each new one looks for the plugins that encrypt bags. Not for all, as one keeps the messages
  /// of every bag that it has written. The first is made with its variable: one made later would be destroyed after the
  /// loader of plugins that it uses until then.
  static rosbag::Bag& writer() {
    constexpr int kBagsAWriter = 1000;
    static std::optional<rosbag::Bag> bag(std::in_place);
    static int bags = 0;
    if (++bags % kBagsAWriter == 0) bag.emplace();
    return *bag;
  }

  void writeMessage() {
    const std::uint8_t kind = input_.byte();
    // A quarter of the messages has odd fields, another one odd bytes.
    has_odd_fields_ = kind >= 64 && kind < 128;
    has_odd_bytes_ = kind >= 128 && kind < 192;
    switch (kind % 16) {
      case 0:
        writeGoal();
        break;
      case 1:
        writeActionGoal();
        break;
      case 2:
        writeEnds();
        break;
      case 3:
        writeTransform();
        break;
      case 4:
      case 5:
      case 6:
      case 7:
      case 8:
        writeScan();
        break;
      default:
        writeOdometry();
    }
  }

  ros::Time stamp() {
    if (!has_odd_fields_) return ros::Time(time_);
    const std::uint32_t seconds = input_.raw<std::uint32_t>();
    return ros::Time(input_.flag() ? seconds : 1000U + seconds % 16, input_.raw<std::uint32_t>() % 1000000000U);
  }

  void number(double* value) {
    if (has_odd_fields_ && input_.byte() % 4 == 0) *value = input_.number();
  }

  void name(std::string* frame) {
    static const std::array<std::string, 6> kFrames = {"", "odom", "/odom", "base_link", "laser", "map"};
    if (has_odd_fields_ && input_.byte() % 4 == 0) *frame = input_.pick(kFrames);
  }

  std_msgs::Header header(std::string frame) {
    std_msgs::Header header;
    header.stamp = stamp();
    name(&frame);
    header.frame_id = frame;
    return header;
  }

  geometry_msgs::Pose pose(double x) {
    geometry_msgs::Pose pose;
    pose.position.x = x;
    pose.orientation.w = 1.0;
    for (double* value :
         {&pose.position.x, &pose.position.y, &pose.orientation.x, &pose.orientation.z, &pose.orientation.w}) {
      number(value);
    }
    return pose;
  }

  template <typename Message>
  void write(const std::string& topic, const Message& message) {
    namespace traits = ros::message_traits;
    RawMessage raw{traits::md5sum(message), traits::datatype(message), traits::definition(message), {}};
    raw.bytes.resize(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(raw.bytes.data(), static_cast<std::uint32_t>(raw.bytes.size()));
    ros::serialization::serialize(stream, message);
    if (has_odd_bytes_) changeBytes(&raw.bytes);
    bag_.write(topic, ros::Time(time_), raw);
  }

  void changeBytes(std::vector<std::uint8_t>* bytes) {
    if (input_.byte() % 4 == 0) bytes->resize(static_cast<std::size_t>(input_.integer(0, 300)));
    for (int count = input_.byte() % 4; count >= 0 && !bytes->empty(); --count) {
      const auto at = static_cast<std::size_t>(input_.raw<std::uint16_t>()) % bytes->size();
      (*bytes)[at] = input_.byte();
    }
  }

  void writeMount() {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].header.frame_id = "base_link";
    message.transforms[0].child_frame_id = "laser";
    message.transforms[0].transform.rotation.w = 1.0;
    write("/tf_static", message);
  }

  void writeTransform() {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].header = header("map");
    message.transforms[0].child_frame_id = "odom";
    name(&message.transforms[0].child_frame_id);
    const geometry_msgs::Pose where = pose(0.0);
    message.transforms[0].transform.translation.x = where.position.x;
    message.transforms[0].transform.rotation = where.orientation;
    write(input_.byte() % 8 == 0 ? "/tf_static" : "/tf", message);
  }

  void writeOdometry() {
    nav_msgs::Odometry odometry;
    odometry.header = header("odom");
    odometry.child_frame_id = "base_link";
    name(&odometry.child_frame_id);
    odometry.pose.pose = pose(0.3 * (time_ - 1000.0));
    odometry.twist.twist.linear.x = 0.3;
    number(&odometry.twist.twist.linear.x);
    number(&odometry.twist.twist.angular.z);
    write("/odom", odometry);
  }

  void writeScan() {
    sensor_msgs::LaserScan scan;
    scan.header = header("laser");
    const LaserScan content = has_odd_fields_
                                  ? anyScan(&input_)
                                  : LaserScan{0.0, -M_PI_2, M_PI / 15.0, 0.1, 30.0, std::vector<float>(16, 3.0f)};
    scan.angle_min = static_cast<float>(content.angle_min);
    scan.angle_increment = static_cast<float>(content.angle_increment);
    scan.range_min = static_cast<float>(content.range_min);
    scan.range_max = static_cast<float>(content.range_max);
    scan.ranges = content.ranges;
    write("/scan", scan);
  }

  geometry_msgs::PoseStamped goal() {
    geometry_msgs::PoseStamped goal;
    goal.header = header("odom");
    goal.pose = pose(4.0);
    return goal;
  }

  void writeGoal() { write("/move_base_simple/goal", goal()); }

  void writeActionGoal() {
    move_base_msgs::MoveBaseActionGoal action;
    action.header.stamp = stamp();
    action.goal_id.id = "a";
    action.goal_id.stamp = stamp();
    action.goal.target_pose = goal();
    write("/move_base/goal", action);
  }

  void writeEnds() {
    if (input_.flag()) {
      actionlib_msgs::GoalID cancel;
      cancel.stamp = stamp();
      write("/move_base/cancel", cancel);
      return;
    }
    move_base_msgs::MoveBaseActionResult result;
    result.header.stamp = stamp();
    result.status.goal_id.id = "a";
    result.status.status = input_.byte() % 10;
    write("/move_base/result", result);
  }

  FuzzInput& input_;
  rosbag::Bag& bag_;
  double time_ = 1000.0;  ///< s
  bool has_odd_fields_ = false;
  bool has_odd_bytes_ = false;
};

RecorderParameters smallWorld() {
  RecorderParameters parameters;
  parameters.agent.memory = smallMemory();
  return parameters;
}

/// Odd messages in a bag that is sound as a file.
void convertBag(const std::uint8_t* data, std::size_t size) {
  static ScratchFile file(".bag");
  console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);  // tf2 writes a line for each odd transform
  FuzzInput input(data, size);
  BagDriveOptions options;
  options.hindsight = input.flag();
  BagMaker(file.path(), &input).make();
  expectRefusal<std::invalid_argument>([&] {
    RecordingSink sink{RecordingDescription{}};
    const BagDriveResult result = recordBags({file.path()}, options, smallWorld(), &sink);
    require(std::isfinite(result.start) && std::isfinite(result.duration), "a bag has a duration");
    for (const RecordedEpisode& episode : sink.recording().episodes) {
      require(isFinite(episode.episode.goal.pose), "goals are finite");
      for (const DriveStep& step : episode.steps) {
        require(isFinite(step.pose) && std::isfinite(step.driven_angle), "steps are finite");
      }
    }
  });
}

const Registration registration("bag", &convertBag);

}  // namespace
}  // namespace lstm_planner::fuzz::bag_harness
