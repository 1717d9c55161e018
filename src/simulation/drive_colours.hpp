#pragma once

#include <opencv2/core/types.hpp>

#include "lstm_planner/drive/decision/decision.hpp"

namespace lstm_planner {

namespace colours {

// Of all pictures of drives: blue, green, red.
inline const cv::Scalar kFree(255, 255, 255);
inline const cv::Scalar kUnknown(205, 205, 205);
inline const cv::Scalar kObstacle(40, 40, 40);
inline const cv::Scalar kStart(130, 40, 0);  ///< and the robot
inline const cv::Scalar kGoal(60, 160, 30);
inline const cv::Scalar kMissedGoal(0, 140, 255);

}  // namespace colours

/// In which colour the path is drawn that was chosen so, along the remembered path or not; blue, green, red.
inline cv::Scalar colorOf(Decision::Choice choice, bool on_path = true) {
  if (choice.move != Decision::Move::kStep) return {130, 130, 130};
  switch (choice.by) {
    case Leader::kNetwork:
      return on_path ? cv::Scalar(40, 40, 220) : cv::Scalar(0, 150, 255);
    case Leader::kGreedy:
      return {170, 60, 120};
    case Leader::kRoute:
      return {235, 130, 20};
    case Leader::kEscape:
      return {150, 150, 0};
  }
  return {130, 130, 130};
}

}  // namespace lstm_planner
