#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

inline bool isSameRange(double a, double b) {
  constexpr double kSameRange = 1e-6;  // m
  return std::abs(a - b) < kSameRange;
}

/// Angles in files have few digits.
inline bool isSame(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kSameAngle = 1e-4;  // rad
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return std::abs(x - y) < kSameAngle; });
}

inline std::string nameOf(const Recording& recording) {
  return "the recording from '" + recording.description.source + "'";
}

}  // namespace lstm_planner
