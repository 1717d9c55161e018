#pragma once

#include <rosbag/message_instance.h>

#include <optional>

namespace lstm_planner {

/// Throws ros::serialization::StreamOverrunException when an array of a scan or of transforms says that it is longer
/// than the message: reading it would reserve memory for all of it before that is noticed.
void checkArrays(const rosbag::MessageInstance& message);

/// Tells stamps that are far ahead of all others, such as 2^32 - 1 s, from a clock that was set: they would make tf
/// forget everything else.
class StampCheck {
 public:
  /// False for a stamp (s) that is more than an hour ahead of when its message was received and of the stamps before,
  /// unless the one before was the same hour's.
  bool isPlausible(double stamp, double received);

 private:
  std::optional<double> newest_;   ///< s
  std::optional<double> refused_;  ///< s, the last one
};

}  // namespace lstm_planner
