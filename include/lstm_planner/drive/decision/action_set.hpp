#pragma once

#include <vector>

namespace lstm_planner {

/// The steering angles between which the agent chooses, rad relative to the heading, from right to left; the thesis's
/// are -90, -45, 0, 45 and 90 degrees (4.2).
class ActionSet {
 public:
  ActionSet();
  /// Throws std::invalid_argument unless the angles are finite, strictly ascending, within [-pi, pi] and at least two.
  explicit ActionSet(std::vector<double> angles);

  int size() const { return static_cast<int>(angles_.size()); }
  double angle(int action) const { return angles_[static_cast<std::size_t>(action)]; }
  const std::vector<double>& angles() const { return angles_; }

  /// The action whose angle is nearest to a direction relative to the heading, rad (thesis Eq. 4.2).
  int nearest(double angle) const;

  bool operator==(const ActionSet& other) const { return angles_ == other.angles_; }

 private:
  std::vector<double> angles_;
};

}  // namespace lstm_planner
