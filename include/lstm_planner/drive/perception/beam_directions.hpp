#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Unit vectors in the directions of a scan's beams. A scanner's beams hardly ever change: sines and cosines are taken
/// once, not once a scan.
class BeamDirections {
 public:
  /// The beams at `first` + i * `increment` (rad); what is there already is kept.
  void set(double first, double increment, std::size_t beams);

  const Point2& operator[](std::size_t beam) const { return vectors_[beam]; }

 private:
  double first_ = 0.0;      ///< rad
  double increment_ = 0.0;  ///< rad
  std::vector<Point2> vectors_;
};

}  // namespace lstm_planner
