#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lstm_planner/agent/grid_agent.hpp"

namespace lstm_planner {

/// The way between the two ends of what has been followed of a boundary, through the place where the agent stands, with
/// loops cut off and bends cut short wherever the rays show that a straight way is free. Kept as the corners of a
/// polyline; bounded: when more corners are needed than there is room for, the trail is lost.
class BoundaryTrail {
 public:
  static constexpr std::size_t kCapacity = 1024;

  explicit BoundaryTrail(CornerCutting corner_cutting) : corner_cutting_(corner_cutting) {}

  /// Both ends are where the agent stands.
  void clear();

  /// The agent has moved by one cell to the observed one; `follows` is the end that it takes along, -1 when it is on
  /// its way between the ends.
  void moved(CellIndex from, const GridObservation& observation, int follows);

  /// More corners were needed than there is room for; nothing below may be asked until clear().
  bool lost() const { return lost_; }

  bool atEnd(int end) const { return ways_[index(end)].empty(); }
  /// Direction of the first step to an end that is elsewhere.
  int directionTo(int end, CellIndex cell) const;
  /// Cells.
  double lengthTo(int end, CellIndex cell) const;
  std::size_t peakBytes() const { return peak_corners_ * sizeof(CellIndex); }

 private:
  using Way = std::vector<CellIndex>;  ///< corners from the end to the one next to the agent

  static std::size_t index(int end) { return static_cast<std::size_t>(end); }
  void extend(Way* way, CellIndex from, CellIndex to);
  void shorten(Way* way, const GridObservation& observation);

  CornerCutting corner_cutting_;
  std::array<Way, 2> ways_;
  std::size_t peak_corners_ = 0;
  bool lost_ = false;
};

}  // namespace lstm_planner
