#pragma once

#include <actionlib_msgs/GoalStatus.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>

namespace lstm_planner {

/// How a goal of an action ended: what the result messages of all actions begin with. A subscriber of this type hears
/// any action's results, also of packages that are not installed here, as mbf_msgs.
struct ActionEnd {
  std_msgs::Header header;
  actionlib_msgs::GoalStatus status;
};

}  // namespace lstm_planner

namespace ros::message_traits {

template <>
struct IsMessage<lstm_planner::ActionEnd> : TrueType {};

template <>
struct MD5Sum<lstm_planner::ActionEnd> {
  static const char* value() { return "*"; }
  static const char* value(const lstm_planner::ActionEnd&) { return value(); }
};

template <>
struct DataType<lstm_planner::ActionEnd> {
  static const char* value() { return "*"; }
  static const char* value(const lstm_planner::ActionEnd&) { return value(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <>
struct Serializer<lstm_planner::ActionEnd> {
  template <typename Stream>
  static void read(Stream& stream, lstm_planner::ActionEnd& end) {
    stream.next(end.header);
    stream.next(end.status);
  }
};

}  // namespace ros::serialization
