#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid_world/agent/rolling_grid.hpp"

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

  /// Cells by which the way is longer than the crow flies from here, after observe() here; infinite without a path.
  double detour(const GridObservation& observation) const;

  const RollingGrid& walls() const { return walls_; }

  std::size_t expandedCells() const { return expanded_; }
  std::size_t bytes() const;

 private:
  static constexpr int kSide = RollingGrid::kSide;
  static constexpr int kStraight = 5;  ///< costs in fifths of a cell
  static constexpr int kDiagonal = 7;
  static constexpr std::size_t kBuckets = 16;        ///< no move raises cost + estimate by more than 14
  static constexpr std::size_t kMostOpen = 2048;     ///< cells open at a time; more are left out
  static constexpr std::size_t kLongestPath = 1024;  ///< steps of the path that are kept
  static constexpr std::uint16_t kNone = 0xfff;
  static constexpr std::uint8_t kUnreached = 15;
  static constexpr std::uint8_t kRoot = 14;

  /// A cell, the direction by which it was reached, and the next one on its list.
  struct OpenCell {
    std::uint32_t cell : 15;
    std::uint32_t direction : 4;
    std::uint32_t next : 12;
  };
  static_assert(kSide * kSide <= 1 << 15 && kMostOpen < kNone, "they fit");

  bool isPathFree(const GridObservation& observation) const;
  void clearPlan();
  void plan(const GridObservation& observation);
  int pop(std::uint16_t* bucket);  ///< -1 for a cell that was reached sooner
  bool isTarget(int cell) const;
  int estimate(int column, int row) const;
  void push(std::size_t bucket, int cell, int direction);
  void expand(int cell, int cost);
  void keepPath(int cell);
  std::uint8_t reachedBy(int cell) const {
    return (reached_by_[static_cast<std::size_t>(cell / 2)] >> (cell % 2 * 4)) & 15u;
  }
  void setReachedBy(int cell, std::uint8_t direction);

  CornerCutting corner_cutting_;
  RollingGrid walls_;
  int direction_ = kNoPath;
  double length_ = 0.0;
  std::size_t expanded_ = 0;

  CellIndex goal_;      ///< from the window's origin
  CellIndex expected_;  ///< where the agent is when it follows the path
  std::size_t path_step_ = 0;
  std::vector<std::uint8_t> path_;  ///< directions from where the plan started

  std::vector<std::uint8_t> reached_by_;  ///< two cells a byte
  std::vector<OpenCell> open_;            ///< on lists: one a bucket and the free ones
  std::uint16_t free_ = kNone;
  std::array<std::uint16_t, kBuckets> buckets_{};
};

}  // namespace lstm_planner
