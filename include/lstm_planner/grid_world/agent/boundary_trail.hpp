#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// The path between the two ends of the followed part of a boundary, through the cell where the agent stands. Loops are
/// cut off, and bends are cut short wherever the rays show that a straight path is free. It is kept as the corners of a
/// polyline in 4 KiB: if there are too many corners, or if one lies more than 32,767 columns or rows from the first,
/// the trail is lost.
class BoundaryTrail {
 public:
  static constexpr std::size_t kCapacity = 1024;

  explicit BoundaryTrail(CornerCutting corner_cutting) : corner_cutting_(corner_cutting) {}

  /// Starts a new trail: both ends are where the agent stands.
  void clear();

  /// The agent has moved by one cell, from `from` to the observed cell. `follows`: the end that moves with it; -1 while
  /// it walks between the ends.
  void moved(CellIndex from, const GridObservation& observation, int follows);

  /// The trail is lost; the functions below must not be called until clear().
  bool lost() const { return lost_; }

  bool atEnd(int end) const { return counts_[index(end)] == 0; }
  /// Direction of the first step from `cell`, where the agent is, to an end at which it is not.
  int directionTo(int end, CellIndex cell) const;
  /// Length of the path from `cell`, where the agent is, to an end; in cells.
  double lengthTo(int end, CellIndex cell) const;

 private:
  /// Cells from origin_.
  struct Corner {
    std::int16_t column;
    std::int16_t row;
  };
  /// While the agent moves by one cell there may be one more at each end.
  static constexpr std::size_t kRoom = kCapacity + 2;

  static std::size_t index(int end) { return static_cast<std::size_t>(end); }
  /// Where corner `i` of the path to an end is kept: counted from the end to the one next to the agent.
  static std::size_t placeOf(int end, std::size_t i) { return end == 0 ? i : kRoom - 1 - i; }
  CellIndex corner(int end, std::size_t i) const;
  CellIndex last(int end) const { return corner(end, counts_[index(end)] - 1); }
  void push(int end, CellIndex cell);
  void extend(int end, CellIndex from, CellIndex to);
  void shorten(int end, const GridObservation& observation);

  CornerCutting corner_cutting_;
  CellIndex origin_;
  std::array<Corner, kRoom> corners_{};  ///< of both paths, from the front and from the back
  std::array<std::size_t, 2> counts_{};
  bool lost_ = false;
};

}  // namespace lstm_planner
