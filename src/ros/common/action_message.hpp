#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>

namespace lstm_planner {

/// What the messages of all actions begin with. A subscriber of this type hears any action's, also of packages that are
/// not installed here, as mbf_msgs.
template <typename Subject>
struct ActionMessage {
  std_msgs::Header header;
  Subject subject;
};

using ActionStart = ActionMessage<actionlib_msgs::GoalID>;    ///< a goal is sent
using ActionEnd = ActionMessage<actionlib_msgs::GoalStatus>;  ///< how a goal ended: the result

/// Whether the goal ended because another one took its place. actionlib's servers tell that from a cancelled goal by
/// the text only.
inline bool isReplaced(const actionlib_msgs::GoalStatus& status) {
  return status.text.find("because another goal was") != std::string::npos;
}

}  // namespace lstm_planner

namespace ros::message_traits {

template <typename Subject>
struct IsMessage<lstm_planner::ActionMessage<Subject>> : TrueType {};

template <typename Subject>
struct MD5Sum<lstm_planner::ActionMessage<Subject>> {
  static const char* value() { return "*"; }
  static const char* value(const lstm_planner::ActionMessage<Subject>&) { return value(); }
};

template <typename Subject>
struct DataType<lstm_planner::ActionMessage<Subject>> {
  static const char* value() { return "*"; }
  static const char* value(const lstm_planner::ActionMessage<Subject>&) { return value(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <typename Subject>
struct Serializer<lstm_planner::ActionMessage<Subject>> {
  template <typename Stream>
  static void read(Stream& stream, lstm_planner::ActionMessage<Subject>& message) {
    stream.next(message.header);
    stream.next(message.subject);
  }
};

}  // namespace ros::serialization
