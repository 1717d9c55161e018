#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/base/grid/grid_rays.hpp"
#include "lstm_planner/base/grid/passable_grid.hpp"

namespace lstm_planner {

/// A* on a square of kSide x kSide nodes in bounded memory: for each node four bits, the move by which it was reached,
/// and a fixed number of open nodes on lists by their cost. If they are used up, further ones are left out, and the
/// path may be longer than the shortest.
///
/// A `World` has `int estimate(int node)` (the least cost to a target; it may fall by no more than a move costs),
/// `bool isTarget(int node)`, and `expand(int node, move)` that calls `move(int direction, int cost)` for every move
/// that is possible from a node that does not lie at the square's edge.
class BoundedSearch {
 public:
  static constexpr int kSide = 160;
  static constexpr int kMostRise = 255;  ///< that a move may raise cost + estimate

  BoundedSearch() : reached_by_(static_cast<std::size_t>(kSide * kSide) / 2), open_(kMostOpen) {}

  /// The target that was reached, or -1.
  template <typename World>
  int find(const World& world, int start);

  /// Of the path to the target that was reached last.
  int cost() const { return cost_; }

  /// Directions from the start of the latest search to a node that it has reached, the first `most` of them.
  void pathTo(int node, std::size_t most, std::vector<std::uint8_t>* directions) const;

  std::size_t expandedNodes() const { return expanded_; }
  void resetCounter() { expanded_ = 0; }

  static constexpr std::size_t bytes() {
    return static_cast<std::size_t>(kSide * kSide) / 2 + kMostOpen * sizeof(OpenNode);
  }

  static int beside(int node, std::size_t direction) {
    const CellIndex step = kGridRaySteps[direction];
    return node + step.row * kSide + step.column;
  }
  static bool atEdge(int node) {
    const int column = node % kSide;
    const int row = node / kSide;
    return column == 0 || row == 0 || column == kSide - 1 || row == kSide - 1;
  }

 private:
  static constexpr std::size_t kBuckets = kMostRise + 1;
  static constexpr std::size_t kMostOpen = 3072;
  static constexpr std::uint16_t kNone = 0xfff;
  static constexpr std::uint8_t kUnreached = 15;
  static constexpr std::uint8_t kRoot = 14;

  /// A node, the move by which it was reached, and the next one on its list.
  struct OpenNode {
    std::uint32_t node : 16;
    std::uint32_t direction : 4;
    std::uint32_t next : 12;
  };
  static_assert(kSide * kSide <= 1 << 16 && kMostOpen < kNone, "they fit");

  void clear();
  void push(int total, int node, std::size_t direction);
  int pop(std::uint16_t* bucket);  ///< -1 for a node that was reached sooner
  std::uint8_t reachedBy(int node) const {
    return (reached_by_[static_cast<std::size_t>(node / 2)] >> (node % 2 * 4)) & 15u;
  }
  void setReachedBy(int node, unsigned direction);

  std::vector<std::uint8_t> reached_by_;  ///< two nodes a byte
  std::vector<OpenNode> open_;            ///< on lists: one a bucket and the free ones
  std::uint16_t free_ = kNone;
  std::array<std::uint16_t, kBuckets> buckets_{};
  std::size_t expanded_ = 0;
  int cost_ = 0;
};

template <typename World>
int BoundedSearch::find(const World& world, int start) {
  clear();
  int total = world.estimate(start);
  push(total, start, kRoot);
  for (std::size_t empty_in_a_row = 0; empty_in_a_row < kBuckets; ++total) {
    std::uint16_t& bucket = buckets_[static_cast<std::size_t>(total) % kBuckets];
    empty_in_a_row = bucket == kNone ? empty_in_a_row + 1 : 0;
    while (bucket != kNone) {
      const int node = pop(&bucket);
      if (node < 0) continue;
      if (world.isTarget(node)) {
        cost_ = total;
        return node;
      }
      if (atEdge(node)) continue;
      const int cost = total - world.estimate(node);
      world.expand(node, [&](std::size_t direction, int length) {
        const int next = beside(node, direction);
        if (reachedBy(next) == kUnreached) push(cost + length + world.estimate(next), next, direction);
      });
    }
  }
  return -1;
}

}  // namespace lstm_planner
