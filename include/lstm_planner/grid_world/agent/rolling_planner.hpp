#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid_world/agent/rolling_grid.hpp"
#include "lstm_planner/grid_world/search/bounded_search.hpp"

namespace lstm_planner {

/// Where the goal would be reached soonest if all that was not sensed were free: A* on a RollingGrid, to the goal or to
/// the edge of the window from where the goal is nearest as the crow flies. Like D* it takes the unknown for free and
/// plans again when a wall turns up in the way; unlike D* its memory is bounded, so it forgets and is not certain to
/// arrive.
class RollingPlanner {
 public:
  explicit RollingPlanner(CornerCutting corner_cutting = CornerCutting::kForbidden);

  void start();

  /// Once before every step, whoever makes it.
  void observe(const GridObservation& observation);

  /// The first move of the path, or kNoPath when the walls enclose the agent or the goal.
  int direction() const { return direction_; }

  /// Length of that path and of the rest as the crow flies, cells (a diagonal counts 1.4); 0 without a path.
  double length() const { return length_; }

  /// Cells by which the path is longer than the crow flies from here, after observe() here; infinite without a path.
  double detour(const GridObservation& observation) const;

  const RollingGrid& walls() const { return walls_; }

  std::size_t expandedCells() const { return search_.expandedNodes(); }
  std::size_t bytes() const;

 private:
  using Search = BoundedSearch<2048, 15>;  // costs in fifths of a cell: no move raises cost + estimate by more than 14
  struct World;

  bool isPathFree(const GridObservation& observation) const;
  void plan(const GridObservation& observation);

  CornerCutting corner_cutting_;
  RollingGrid walls_;
  Search search_;
  int direction_ = kNoPath;
  double length_ = 0.0;

  CellIndex expected_;  ///< where the agent is when it follows the path
  std::size_t path_step_ = 0;
  std::vector<std::uint8_t> path_;  ///< directions from where the plan started
};

}  // namespace lstm_planner
