#include "ros/common/frame_transformer.hpp"

#include "lstm_planner/drive/perception/message_age.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/common/timing.hpp"

namespace lstm_planner {

Pose2 FrameTransformer::transform(const std::string& target, const std::string& source, const ros::Time& now) const {
  if (target == source) {
    return {};
  }
  geometry_msgs::TransformStamped transform;
  try {
    transform = tf_.lookupTransform(target, source, ros::Time(0));
  } catch (const tf2::TransformException& error) {
    throw FrameError("no transform from " + source + " to " + target + ": " + error.what());
  }
  const bool is_static = transform.header.stamp.isZero();
  if (!is_static && timeout_ > 0.0) {
    const double age = secondsBetween(transform.header.stamp, now);
    const std::string problem = ageProblem(age, timeout_, "tf_timeout");
    const std::string sentence = "the newest transform from " + source + " to " + target + " is " + problem;
    if (!problem.empty() && age < 0.0) throw FutureTransform(sentence);
    if (!problem.empty()) throw FrameError(sentence);
  }
  const Pose2 pose = fromMessage(transform.transform);
  if (!isFinite(pose)) throw FrameError("the transform from " + source + " to " + target + " is not finite");
  return pose;
}

Pose2 FrameTransformer::transformAt(const std::string& target, const std::string& source, const ros::Time& time,
                                    const ros::Time& now) const {
  if (target != source && !time.isZero() && tf_.canTransform(target, source, time)) {
    return fromMessage(tf_.lookupTransform(target, source, time).transform);
  }
  return transform(target, source, now);
}

}  // namespace lstm_planner
