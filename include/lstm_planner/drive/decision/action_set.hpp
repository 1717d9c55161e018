#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

/// The steering angles between which the agent chooses, rad relative to the heading, from right to left; the thesis's
/// are -90, -45, 0, 45 and 90 degrees (4.2).
class ActionSet {
 public:
  ActionSet() : ActionSet({-M_PI_2, -M_PI_4, 0.0, M_PI_4, M_PI_2}) {}
  /// Throws std::invalid_argument unless the angles are finite, strictly ascending, within [-pi, pi] and at least two.
  explicit ActionSet(std::vector<double> angles) : angles_(std::move(angles)) {
    if (angles_.size() < 2) {
      throw std::invalid_argument("the action set has " + std::to_string(angles_.size()) +
                                  " steering angles, at least two are needed");
    }
    for (std::size_t i = 0; i < angles_.size(); ++i) {
      if (!std::isfinite(angles_[i]) || std::abs(angles_[i]) > M_PI || (i > 0 && angles_[i] <= angles_[i - 1])) {
        throw std::invalid_argument("steering angle " + std::to_string(i) + " is " + numberText(angles_[i]) +
                                    ", expected ascending angles within [-pi, pi]");
      }
    }
  }

  int size() const { return static_cast<int>(angles_.size()); }
  double angle(int action) const { return angles_[static_cast<std::size_t>(action)]; }
  const std::vector<double>& angles() const { return angles_; }

  /// The action whose angle is nearest to a direction relative to the heading, rad (thesis Eq. 4.2).
  int nearest(double angle) const {
    int best = 0;
    for (int action = 1; action < size(); ++action) {
      if (std::abs(normalizeAngle(angle - this->angle(action))) < std::abs(normalizeAngle(angle - this->angle(best)))) {
        best = action;
      }
    }
    return best;
  }

  bool operator==(const ActionSet& other) const { return angles_ == other.angles_; }

 private:
  std::vector<double> angles_;
};

}  // namespace lstm_planner
