#pragma once

#include <optional>
#include <vector>

#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"

namespace lstm_planner {

/// Picks way-points at random, never the same twice in a row; the same order for the same seed on every machine.
class WayPointPicker {
 public:
  WayPointPicker(const std::vector<NamedPose>& way_points, int seed)
      : way_points_(way_points), random_(static_cast<Random::result_type>(seed)) {}

  bool empty() const { return way_points_.empty(); }

  /// Requires !empty().
  const NamedPose& next() {
    std::size_t i = uniformIndex(random_, way_points_.size() - (last_ ? 1 : 0));
    if (last_ && i >= *last_) ++i;
    last_ = i;
    return way_points_.at(i);
  }

 private:
  std::vector<NamedPose> way_points_;
  Random random_;
  std::optional<std::size_t> last_;
};

}  // namespace lstm_planner
