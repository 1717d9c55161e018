#pragma once

#include <ros/ros.h>

#include <functional>

namespace lstm_planner {

inline void spinBriefly() {
  ros::spinOnce();
  ros::WallDuration(0.001).sleep();
}

inline void sleepBriefly() { ros::WallDuration(0.002).sleep(); }

/// True as soon as the condition holds; false when it does not within so many seconds of the computer's clock.
/// `pass`: what is done in between.
inline bool eventually(const std::function<bool()>& condition, double seconds = 10.0,
                       const std::function<void()>& pass = sleepBriefly) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::ok() && ros::WallTime::now() < deadline) {
    if (condition()) return true;
    pass();
  }
  return condition();
}

}  // namespace lstm_planner
