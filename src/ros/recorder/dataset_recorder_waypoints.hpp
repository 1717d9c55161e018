#pragma once

#include <optional>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"

namespace lstm_planner {

/// Picks waypoints at random, never the same twice in a row; the same order for the same seed on every machine.
class WaypointPicker {
 public:
  WaypointPicker(const std::vector<NamedPose>& waypoints, int seed)
      : waypoints_(waypoints), random_(static_cast<Random::result_type>(seed)) {}

  bool empty() const { return waypoints_.empty(); }

  /// Requires !empty().
  const NamedPose& next() {
    std::size_t i = uniformIndex(random_, waypoints_.size() - (last_ ? 1 : 0));
    if (last_ && i >= *last_) ++i;
    last_ = i;
    return waypoints_.at(i);
  }

 private:
  std::vector<NamedPose> waypoints_;
  Random random_;
  std::optional<std::size_t> last_;
};

}  // namespace lstm_planner
