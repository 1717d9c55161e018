#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <tf2_ros/buffer.h>

#include <string>

namespace lstm_planner {

/// The goal in `frame`, at the newest transform. Throws std::invalid_argument when it has no frame, a position that is
/// not finite, an orientation that is no rotation about the vertical, or a frame that tf does not connect to `frame`.
geometry_msgs::PoseStamped goalInFrame(const geometry_msgs::PoseStamped& goal, const std::string& frame,
                                       const tf2_ros::Buffer& tf);

}  // namespace lstm_planner
