#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Unit vectors in the directions of a scan's beams. A scanner's beams hardly ever change: sines and cosines are taken
/// once, not once a scan.
class BeamDirections {
 public:
  /// The beams at `first` + i * `increment` (rad); what is there already is kept.
  void set(double first, double increment, std::size_t beams) {
    if (first == first_ && increment == increment_ && beams == vectors_.size()) {
      return;
    }
    first_ = first;
    increment_ = increment;
    vectors_.resize(beams);
    for (std::size_t i = 0; i < beams; ++i) {
      const double direction = first + static_cast<double>(i) * increment;
      vectors_[i] = {std::cos(direction), std::sin(direction)};
    }
  }

  const Point2& operator[](std::size_t beam) const { return vectors_[beam]; }

 private:
  double first_ = 0.0;      ///< rad
  double increment_ = 0.0;  ///< rad
  std::vector<Point2> vectors_;
};

}  // namespace lstm_planner
