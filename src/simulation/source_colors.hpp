#pragma once

#include <opencv2/core/types.hpp>

#include "lstm_planner/drive/decision/decision.hpp"

namespace lstm_planner {

/// In which colour the path is drawn that somebody decided, along the remembered path or not; blue, green, red.
inline cv::Scalar colorOf(Decision::Source source, bool on_path = true) {
  switch (source) {
    case Decision::Source::kNetwork:
      return on_path ? cv::Scalar(40, 40, 220) : cv::Scalar(0, 150, 255);
    case Decision::Source::kGreedy:
      return {170, 60, 120};
    case Decision::Source::kRoute:
      return {235, 130, 20};
    case Decision::Source::kEscape:
      return {150, 150, 0};
    default:
      return {130, 130, 130};
  }
}

}  // namespace lstm_planner
