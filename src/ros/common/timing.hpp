#pragma once

#include <ros/time.h>

namespace lstm_planner {

/// s; what is still wrong is said again after that long.
constexpr double kLogPeriod = 2.0;

/// From `then` to `now`, s, for any two stamps: the difference of ros::Time throws beyond 68 years.
inline double secondsBetween(const ros::Time& then, const ros::Time& now) { return now.toSec() - then.toSec(); }

/// Time since something happened, by ROS's clock. When the clock is set back it starts anew: a wait is then at most
/// twice as long as it should be, and not endless. What happened before there was a simulated time (0) counts from the
/// first one on.
class Stopwatch {
 public:
  void restart() { since_ = ros::Time::now(); }

  /// Whether it happened more than `duration` s ago.
  bool isLongerAgo(double duration) {
    const ros::Time now = ros::Time::now();
    if (since_.isZero() || now < since_) since_ = now;
    return now.toSec() - since_.toSec() > duration;
  }

 private:
  ros::Time since_;
};

}  // namespace lstm_planner
