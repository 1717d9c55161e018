#pragma once

#include <ros/time.h>

namespace lstm_planner {

/// From `then` to `now`, s, for any two stamps: the difference of ros::Time throws beyond 68 years.
inline double secondsBetween(const ros::Time& then, const ros::Time& now) { return now.toSec() - then.toSec(); }

}  // namespace lstm_planner
