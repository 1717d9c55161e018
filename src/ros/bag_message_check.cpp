#include "bag_message_check.hpp"

#include <ros/serialization.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace lstm_planner {

namespace {

using ros::serialization::IStream;

/// Goes behind an array, whose elements take at least so many bytes.
void skipArray(IStream* stream, std::uint32_t element) {
  std::uint32_t count = 0;
  stream->next(count);
  const std::uint64_t bytes = std::uint64_t{count} * element;
  if (bytes > stream->getLength()) ros::serialization::throwStreamOverrun();
  stream->advance(static_cast<std::uint32_t>(bytes));
}

}  // namespace

void checkArrays(const rosbag::MessageInstance& message) {
  constexpr std::uint32_t kHeader = 12;                  // bytes, without the frame
  constexpr std::uint32_t kScanLimits = 7 * 4;           // bytes
  constexpr std::uint32_t kShortestTransform = 20 + 56;  // bytes, with empty names
  const bool is_scan = message.getMD5Sum() == ros::message_traits::MD5Sum<sensor_msgs::LaserScan>::value();
  const bool is_tf = message.getMD5Sum() == ros::message_traits::MD5Sum<tf2_msgs::TFMessage>::value();
  if (!is_scan && !is_tf) return;
  std::vector<std::uint8_t> bytes(message.size());
  ros::serialization::OStream copy(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  message.write(copy);
  IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  if (is_tf) return skipArray(&stream, kShortestTransform);
  stream.advance(kHeader);
  skipArray(&stream, 1);  // the frame
  stream.advance(kScanLimits);
  skipArray(&stream, sizeof(float));  // ranges
  skipArray(&stream, sizeof(float));  // intensities
}

bool StampCheck::isPlausible(double stamp, double received) {
  constexpr double kHour = 3600.0;  // s
  const bool is_near = stamp <= std::max(received, newest_.value_or(received)) + kHour;
  const bool is_other_clock = refused_ && std::abs(stamp - *refused_) <= kHour;
  if (is_near || is_other_clock) {
    newest_ = stamp;
    return true;
  }
  refused_ = stamp;
  return false;
}

}  // namespace lstm_planner
