#include "lstm_planner/ros/frame_transformer.hpp"

#include "lstm_planner/ros/conversions.hpp"

namespace lstm_planner {

Pose2 FrameTransformer::transform(const std::string& target, const std::string& source) const {
  if (target == source) {
    return {};
  }
  try {
    return fromMessage(tf_.lookupTransform(target, source, ros::Time(0)).transform);
  } catch (const tf2::TransformException& error) {
    throw FrameError("no transform from " + source + " to " + target + ": " + error.what());
  }
}

Pose2 FrameTransformer::transform(const std::string& target, const std::string& source, const ros::Time& time) const {
  if (target != source && !time.isZero() && tf_.canTransform(target, source, time)) {
    return fromMessage(tf_.lookupTransform(target, source, time).transform);
  }
  return transform(target, source);
}

}  // namespace lstm_planner
