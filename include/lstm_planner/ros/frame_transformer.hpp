#pragma once

#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <stdexcept>
#include <string>

#include "lstm_planner/geometry.hpp"

namespace lstm_planner {

/// A transform that is not known; what() says which and why.
class FrameError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Planar transforms between frames; never waits for one.
class FrameTransformer {
 public:
  /// `tf` must outlive the object.
  explicit FrameTransformer(const tf2_ros::Buffer& tf) : tf_(tf) {}

  /// Pose of the frame `source` in the frame `target`, from the newest transforms there are. Throws FrameError.
  Pose2 transform(const std::string& target, const std::string& source) const;

  /// The same at a time, s; from the newest transforms when the time is zero or not covered.
  Pose2 transform(const std::string& target, const std::string& source, const ros::Time& time) const;

 private:
  const tf2_ros::Buffer& tf_;
};

}  // namespace lstm_planner
