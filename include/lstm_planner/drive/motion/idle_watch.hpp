#pragma once

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Notices that a robot does not do what it is told: nobody hears its commands, or its motors are off.
class IdleWatch {
 public:
  /// The robot is here by its odometry at that time (s), and is given a command.
  void note(const Pose2& pose, double time, const Twist2& command);

  /// s for which it has been told to move since it last did; 0 as long as that is less than any base takes to start.
  double idle() const;

 private:
  Pose2 pose_;  ///< when it last moved
  double time_ = 0.0;
  bool is_told_ = false;
  double told_ = 0.0;  ///< s
};

}  // namespace lstm_planner
