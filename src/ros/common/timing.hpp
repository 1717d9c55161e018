#pragma once

#include <ros/time.h>

namespace lstm_planner {

/// s; what is still wrong is said again after that long.
constexpr double kLogPeriod = 2.0;

/// From `then` to `now`, s, for any two stamps: the difference of ros::Time throws beyond 68 years.
inline double secondsBetween(const ros::Time& then, const ros::Time& now) { return now.toSec() - then.toSec(); }

/// Notices that ROS's clock stands still, as that of a simulator which is paused: by it nothing grows old.
class StandingClock {
 public:
  static constexpr const char* kText = "the clock stands still: the simulator or rosbag is paused, or has ended";

  /// Whether it has not moved for 2 s of the computer's time. To be asked again and again.
  bool stands() {
    constexpr double kStands = 2.0;  // s
    const ros::Time time = ros::Time::now();
    const ros::SteadyTime now = ros::SteadyTime::now();
    if (time != time_ || since_.isZero()) since_ = now;
    time_ = time;
    return (now - since_).toSec() > kStands;
  }

 private:
  ros::Time time_;
  ros::SteadyTime since_;
};

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
