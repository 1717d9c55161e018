#include "lstm_planner/grid_world/agent/rolling_planner.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

namespace {

/// The moves that walls beside leave, both with bit d for direction d.
unsigned movesBetween(unsigned walls, CornerCutting corner_cutting) {
  constexpr unsigned kDiagonals = 0xaa;
  unsigned blocked = walls;
  if (corner_cutting == CornerCutting::kForbidden) {
    blocked |= (walls << 1 | walls >> 7 | walls >> 1 | walls << 7) & kDiagonals;
  }
  return ~blocked & 0xff;
}

}  // namespace

RollingPlanner::RollingPlanner(CornerCutting corner_cutting)
    : corner_cutting_(corner_cutting), reached_by_(static_cast<std::size_t>(kSide * kSide) / 2), open_(kMostOpen) {
  path_.reserve(kLongestPath);
}

void RollingPlanner::start() {
  walls_.clear();
  path_.clear();
  path_step_ = 0;
  direction_ = kNoPath;
  expanded_ = 0;
}

std::size_t RollingPlanner::bytes() const {
  return sizeof(*this) + walls_.bytes() + reached_by_.size() + kMostOpen * sizeof(OpenCell) + kLongestPath;
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
  for (std::size_t step = 0; step + 1 < path_step_; ++step) walked += path_[step] % 2 != 0 ? kDiagonal : kStraight;
  const double left = length_ - static_cast<double>(walked) / kStraight;
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

void RollingPlanner::setReachedBy(int cell, std::uint8_t direction) {
  std::uint8_t& both = reached_by_[static_cast<std::size_t>(cell / 2)];
  both = static_cast<std::uint8_t>((both & (cell % 2 == 0 ? 0xf0u : 0x0fu)) | (direction << (cell % 2 * 4)));
}

int RollingPlanner::estimate(int column, int row) const {
  const int columns = std::abs(goal_.column - column);
  const int rows = std::abs(goal_.row - row);
  return kStraight * std::max(columns, rows) + (kDiagonal - kStraight) * std::min(columns, rows);
}

void RollingPlanner::push(std::size_t bucket, int cell, int direction) {
  if (free_ == kNone) return;
  const std::uint16_t entry = free_;
  OpenCell& open = open_[entry];
  free_ = open.next;
  open.cell = static_cast<std::uint32_t>(cell) & 0x7fffu;
  open.direction = static_cast<std::uint32_t>(direction) & 0xfu;
  open.next = buckets_[bucket] & 0xfffu;
  buckets_[bucket] = entry;
}

void RollingPlanner::clearPlan() {
  std::fill(reached_by_.begin(), reached_by_.end(), std::uint8_t{kUnreached << 4 | kUnreached});
  for (std::size_t entry = 0; entry < kMostOpen; ++entry) {
    open_[entry].next = (entry + 1 < kMostOpen ? static_cast<std::uint32_t>(entry + 1) : kNone) & 0xfffu;
  }
  free_ = 0;
  buckets_.fill(kNone);
  path_.clear();
  path_step_ = 0;
  length_ = 0.0;
}

void RollingPlanner::plan(const GridObservation& observation) {
  const CellIndex origin = walls_.origin();
  clearPlan();
  goal_ = {observation.goal.column - origin.column, observation.goal.row - origin.row};
  const int column = observation.cell.column - origin.column;
  const int row = observation.cell.row - origin.row;
  int total = estimate(column, row);
  push(static_cast<std::size_t>(total) % kBuckets, row * kSide + column, kRoot);
  for (std::size_t empty_in_a_row = 0; empty_in_a_row < kBuckets; ++total) {
    std::uint16_t& bucket = buckets_[static_cast<std::size_t>(total) % kBuckets];
    empty_in_a_row = bucket == kNone ? empty_in_a_row + 1 : 0;
    while (bucket != kNone) {
      const int cell = pop(&bucket);
      if (cell < 0) continue;
      if (isTarget(cell)) {
        length_ = static_cast<double>(total) / kStraight;
        keepPath(cell);
        return;
      }
      expand(cell, total - estimate(cell % kSide, cell / kSide));
    }
  }
}

int RollingPlanner::pop(std::uint16_t* bucket) {
  const std::uint16_t entry = *bucket;
  OpenCell& open = open_[entry];
  *bucket = static_cast<std::uint16_t>(open.next);
  open.next = free_ & 0xfffu;
  free_ = entry;
  const int cell = static_cast<int>(open.cell);
  if (reachedBy(cell) != kUnreached) return -1;
  setReachedBy(cell, static_cast<std::uint8_t>(open.direction));
  ++expanded_;
  return cell;
}

bool RollingPlanner::isTarget(int cell) const {
  const int column = cell % kSide;
  const int row = cell / kSide;
  const bool at_edge = column == 0 || row == 0 || column == kSide - 1 || row == kSide - 1;
  return at_edge || (column == goal_.column && row == goal_.row);
}

void RollingPlanner::expand(int cell, int cost) {
  const int column = cell % kSide;
  const int row = cell / kSide;
  const unsigned moves = movesBetween(walls_.wallsBeside(column, row), corner_cutting_);
  for (std::size_t direction = 0; direction < kGridMoveCount; ++direction) {
    if ((moves >> direction & 1u) == 0) continue;
    const CellIndex step = kGridRaySteps[direction];
    const int next = cell + step.row * kSide + step.column;
    if (reachedBy(next) != kUnreached) continue;
    const int length = direction % 2 != 0 ? kDiagonal : kStraight;
    const int total = cost + length + estimate(column + step.column, row + step.row);
    push(static_cast<std::size_t>(total) % kBuckets, next, static_cast<int>(direction));
  }
}

void RollingPlanner::keepPath(int cell) {
  const auto before = [&](int later) {
    const CellIndex step = kGridRaySteps[reachedBy(later)];
    return later - step.row * kSide - step.column;
  };
  std::size_t steps = 0;
  for (int at = cell; reachedBy(at) != kRoot; at = before(at)) ++steps;
  for (; reachedBy(cell) != kRoot; cell = before(cell)) {
    if (--steps < kLongestPath) path_.push_back(reachedBy(cell));
  }
  std::reverse(path_.begin(), path_.end());
}

}  // namespace lstm_planner
