#pragma once

#include <ros/time.h>

#include <string>

namespace lstm_planner {

/// From `then` to `now`, s, for any two stamps: the difference of ros::Time throws beyond 68 years.
inline double secondsBetween(const ros::Time& then, const ros::Time& now) { return now.toSec() - then.toSec(); }

/// What is wrong with a message that is `age` s old, by its stamp, where at most `timeout` s are allowed: the rest of a
/// sentence that starts with "... is"; empty when nothing is. Stamps further than `timeout` in the future are refused,
/// too. `parameter`: the name of the parameter that holds the timeout.
std::string ageProblem(double age, double timeout, const std::string& parameter);

}  // namespace lstm_planner
