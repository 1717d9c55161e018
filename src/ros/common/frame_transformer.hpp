#pragma once

#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/message_age.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/common/timing.hpp"

namespace lstm_planner {

/// A transform that is not known or too old; what() says which and why.
class FrameError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The newest transform is stamped too far in the future: the clock was set back, or the clocks differ.
class FutureTransform : public FrameError {
 public:
  using FrameError::FrameError;
};

/// Planar transforms between frames; never waits for one. Static ones are never too old.
class FrameTransformer {
 public:
  /// `tf` must outlive the object. `timeout`: s; older transforms are not used, nor those stamped farther ahead than
  /// any localisation does (3 s, or the timeout if that is longer); 0 = any will do.
  FrameTransformer(const tf2_ros::Buffer& tf, double timeout) : tf_(tf), timeout_(timeout) {}

  /// Pose of the frame `source` in the frame `target`, from the newest transforms there are. Throws FrameError,
  /// FutureTransform where that is the reason.
  Pose2 transform(const std::string& target, const std::string& source, const ros::Time& now) const {
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
      const std::string newest = "the newest transform from " + source + " to " + target + " is ";
      const double allowed = std::max(timeout_, kMostAhead);
      if (-age > allowed) {
        throw FutureTransform(newest + "stamped " + std::to_string(-age) + " s in the future, allowed are " +
                              std::to_string(allowed) + " s: the clocks differ (NTP), or the localisation's " +
                              "transform_tolerance is larger");
      }
      const std::string problem = ageProblem(std::max(0.0, age), timeout_, "tf_timeout");
      if (!problem.empty()) throw FrameError(newest + problem);
    }
    const Pose2 pose = fromMessage(transform.transform);
    if (!isFinite(pose)) throw FrameError("the transform from " + source + " to " + target + " is not finite");
    return pose;
  }

  /// The same at another time; none when that time is zero or not covered.
  std::optional<Pose2> transformThen(const std::string& target, const std::string& source,
                                     const ros::Time& time) const {
    if (time.isZero() || !tf_.canTransform(target, source, time)) return std::nullopt;
    return fromMessage(tf_.lookupTransform(target, source, time).transform);
  }

  /// The same at another time; from the newest transforms when that time is zero or not covered.
  Pose2 transformAt(const std::string& target, const std::string& source, const ros::Time& time,
                    const ros::Time& now) const {
    const auto then = target == source ? std::nullopt : transformThen(target, source, time);
    return then ? *then : transform(target, source, now);
  }

 private:
  /// s; a localisation stamps its transforms ahead by its transform_tolerance (amcl: 0.1 s, many robots: 0.5 or 1 s),
  /// because they hold until the next one.
  static constexpr double kMostAhead = 3.0;

  const tf2_ros::Buffer& tf_;
  double timeout_;
};

}  // namespace lstm_planner
