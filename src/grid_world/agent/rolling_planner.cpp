#include "lstm_planner/grid_world/agent/rolling_planner.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "grid_world/agent/moves_between.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

namespace {

constexpr std::size_t kLongestKeptPath = 1024;  ///< steps of the path that are kept

}  // namespace

/// The window, its cells counted from its origin.
struct RollingPlanner::World {
  const RollingGrid& walls;
  CornerCutting corner_cutting;
  CellIndex goal;

  int estimate(CellIndex cell) const { return octileFifths(goal.column - cell.column, goal.row - cell.row); }
  bool isTarget(CellIndex cell) const { return Search::atEdge(cell) || cell == goal; }
  template <typename Move>
  void expand(CellIndex cell, const Move& move) const {
    const unsigned moves = movesBetween(walls.wallsBeside(cell.column, cell.row), corner_cutting);
    for (std::size_t direction = 0; direction < kGridMoveCount; ++direction) {
      if ((moves >> direction & 1u) != 0) move(direction, direction % 2 != 0 ? kDiagonalFifths : kStraightFifths);
    }
  }
};

RollingPlanner::RollingPlanner(CornerCutting corner_cutting) : corner_cutting_(corner_cutting) {
  static_assert(RollingGrid::kSide == Search::kSide, "the search covers the window");
  path_.reserve(kLongestKeptPath);
}

void RollingPlanner::start() {
  walls_.clear();
  path_.clear();
  path_step_ = 0;
  direction_ = kNoPath;
  search_.resetCounter();
}

std::size_t RollingPlanner::bytes() const {
  return sizeof(*this) + walls_.bytes() + Search::bytes() + kLongestKeptPath;
}

void RollingPlanner::observe(const GridObservation& observation) {
  const bool is_new = walls_.observe(observation);
  if (expected_ != observation.cell) path_.clear();
  if (path_step_ >= path_.size() || (is_new && !isPathFree(observation))) plan(observation);
  direction_ = kNoPath;
  if (path_step_ >= path_.size()) return;
  direction_ = path_[path_step_++];
  expected_ = cellBeside(observation.cell, direction_);
}

double RollingPlanner::detour(const GridObservation& observation) const {
  if (direction_ == kNoPath) return std::numeric_limits<double>::infinity();
  int walked = 0;
  for (std::size_t step = 0; step + 1 < path_step_; ++step)
    walked += path_[step] % 2 != 0 ? kDiagonalFifths : kStraightFifths;
  const double left = length_ - static_cast<double>(walked) / kStraightFifths;
  return left - octileDistance(observation.cell, observation.goal).length();
}

bool RollingPlanner::isPathFree(const GridObservation& observation) const {
  CellIndex cell = observation.cell;
  for (std::size_t step = path_step_; step < path_.size(); ++step) {
    const int direction = path_[step];
    const CellIndex next = cellBeside(cell, direction);
    if (walls_.isWall(next)) return false;
    if (direction % 2 != 0 && corner_cutting_ == CornerCutting::kForbidden &&
        (walls_.isWall({next.column, cell.row}) || walls_.isWall({cell.column, next.row}))) {
      return false;
    }
    cell = next;
  }
  return true;
}

void RollingPlanner::plan(const GridObservation& observation) {
  const CellIndex origin = walls_.origin();
  const CellIndex goal{observation.goal.column - origin.column, observation.goal.row - origin.row};
  path_.clear();
  path_step_ = 0;
  length_ = 0.0;
  const CellIndex start{observation.cell.column - origin.column, observation.cell.row - origin.row};
  if (!search_.find(World{walls_, corner_cutting_, goal}, start)) return;
  length_ = static_cast<double>(search_.cost()) / kStraightFifths;
  search_.path(kLongestKeptPath, &path_);
}

}  // namespace lstm_planner
