#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "ros/recorder/bag_message.hpp"

namespace lstm_planner::test_bag_message {
namespace {

template <typename Message>
std::vector<std::uint8_t> bytesOf(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <typename Message>
Message read(std::vector<std::uint8_t> bytes) {
  MessageBytes stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  Message message;
  ros::serialization::deserialize(stream, message);
  return message;
}

sensor_msgs::LaserScan exampleScan() {
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "laser";
  scan.ranges = {1.0f, 2.0f, 3.0f};
  scan.intensities = {4.0f};
  return scan;
}

/// The scan's ranges are behind its header and seven numbers.
std::vector<std::uint8_t> scanOfLength(std::uint32_t ranges) {
  std::vector<std::uint8_t> bytes = bytesOf(exampleScan());
  const std::size_t place = 16 + exampleScan().header.frame_id.size() + 7 * sizeof(float);
  std::memcpy(bytes.data() + place, &ranges, sizeof(ranges));
  return bytes;
}

TEST(BagMessage, IsReadAsItWasWritten) {
  EXPECT_EQ(read<sensor_msgs::LaserScan>(bytesOf(exampleScan())), exampleScan());
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(2);
  transforms.transforms[1].child_frame_id = "laser";
  EXPECT_EQ(read<tf2_msgs::TFMessage>(bytesOf(transforms)), transforms);
}

TEST(BagMessage, TakesNoListThatIsLongerThanTheMessage) {
  EXPECT_THROW(read<sensor_msgs::LaserScan>(scanOfLength(5)), ros::Exception);
  // In 32 bits four times this length is 4: ROS's own stream takes 4 GB, reads one range and is content.
  EXPECT_THROW(read<sensor_msgs::LaserScan>(scanOfLength(0x40000001)), ros::Exception);
  EXPECT_THROW(read<tf2_msgs::TFMessage>({0xff, 0xff, 0xff, 0x00, 0, 0, 0, 0}), ros::Exception);
}

TEST(BagMessage, MayBeCutOffAnywhere) {
  const std::vector<std::uint8_t> whole = bytesOf(exampleScan());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::vector<std::uint8_t> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(read<sensor_msgs::LaserScan>(part), ros::Exception) << size;
  }
}

}  // namespace
}  // namespace lstm_planner::test_bag_message
