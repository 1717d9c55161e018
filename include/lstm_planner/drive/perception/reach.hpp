#pragma once

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// m from the origin of the odometry frame along each axis up to which poses are used: all UTM coordinates lie within,
/// and squares of the memory can be counted in 32 bits.
constexpr double kFarthestPose = 1e7;

/// m from the robot up to which a goal is driven to. Odometry and memory are of no use for more, and a goal that lies
/// farther away was most likely given in another frame.
constexpr double kFarthestGoal = 1e4;

/// m; a goal that is given or corrected again within this distance is the same goal, farther away it is another one.
constexpr double kGoalShift = 0.25;

/// False where something is not finite, too.
bool isInReach(const Pose2& pose);
bool isInReach(const Pose2& pose, const Point2& goal);

/// Throw std::invalid_argument with the distance and what is allowed.
void checkPose(const Pose2& pose);
void checkGoal(const Pose2& pose, const Point2& goal);

}  // namespace lstm_planner
