#pragma once

#include <opencv2/core/types.hpp>

namespace lstm_planner::colours {

// Of all pictures of drives: blue, green, red.
inline const cv::Scalar kFree(255, 255, 255);
inline const cv::Scalar kUnknown(205, 205, 205);
inline const cv::Scalar kObstacle(40, 40, 40);
inline const cv::Scalar kStart(130, 40, 0);  ///< and the robot
inline const cv::Scalar kGoal(60, 160, 30);
inline const cv::Scalar kMissedGoal(0, 140, 255);

}  // namespace lstm_planner::colours
