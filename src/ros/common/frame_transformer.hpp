#pragma once

#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <stdexcept>
#include <string>

#include "lstm_planner/common/geometry.hpp"

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
  Pose2 transform(const std::string& target, const std::string& source, const ros::Time& now) const;

  /// The same at another time; from the newest transforms when that time is zero or not covered.
  Pose2 transformAt(const std::string& target, const std::string& source, const ros::Time& time,
                    const ros::Time& now) const;

 private:
  const tf2_ros::Buffer& tf_;
  double timeout_;
};

}  // namespace lstm_planner
