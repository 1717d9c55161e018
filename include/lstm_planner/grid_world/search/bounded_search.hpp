#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid/grid_rays.hpp"
#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// A* on a square of kSide x kSide nodes in bounded memory: four bits for each node (the move by which it was reached),
/// and a fixed number of open nodes on lists by their cost. If there are more open nodes, the others are left out, and
/// the path may be longer than the shortest.
///
/// Places are counted from the square's corner. A `World` has `int estimate(CellIndex place)` (the least cost to a
/// target; a move may reduce it by at most its own cost), `bool isTarget(CellIndex place)`, and `expand(CellIndex
/// place, move)`, which calls `move(std::size_t direction, int cost)` for every possible move from a place that is not
/// at the square's edge.
class BoundedSearch {
 public:
  static constexpr int kSide = 160;

  BoundedSearch() : reached_by_(static_cast<std::size_t>(kSide * kSide) / 2), open_(kMostOpen) {}

  /// Whether a target was reached.
  template <typename World>
  bool find(const World& world, CellIndex start);

  /// Cost of the path to the target that was reached last.
  int cost() const { return cost_; }
  /// The first `most` directions of that path.
  void path(std::size_t most, std::vector<std::uint8_t>* directions) const;

  std::size_t expandedNodes() const { return expanded_; }
  void resetCounter() { expanded_ = 0; }

  static constexpr std::size_t bytes() {
    return static_cast<std::size_t>(kSide * kSide) / 2 + kMostOpen * sizeof(OpenNode);
  }

  static bool atEdge(CellIndex place) {
    return place.column == 0 || place.row == 0 || place.column == kSide - 1 || place.row == kSide - 1;
  }

 private:
  static constexpr std::size_t kMostOpen = 3072;  ///< nodes that are open at a time
  static constexpr int kMostRise = 255;           ///< by which a move may raise cost + estimate
  static constexpr std::size_t kBuckets = kMostRise + 1;
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

  static int nodeOf(CellIndex place) { return place.row * kSide + place.column; }

  void clear();
  void push(int total, int node, std::size_t direction);
  int pop(std::uint16_t* bucket);  ///< -1 for a node that was reached sooner
  std::uint8_t reachedBy(int node) const {
    return (reached_by_[static_cast<std::size_t>(node / 2)] >> (node % 2 * 4)) & 15u;
  }
  void setReachedBy(int node, unsigned direction);

  std::vector<std::uint8_t> reached_by_;  ///< two nodes a byte
  std::vector<OpenNode> open_;            ///< on lists: one a bucket and the free ones
  std::uint16_t free_ = kNone;            ///< the first entry that is free again
  std::size_t fresh_ = 0;                 ///< the first entry that was never used
  std::array<std::uint16_t, kBuckets> buckets_{};
  std::size_t expanded_ = 0;
  int cost_ = 0;
  int target_ = 0;
};

template <typename World>
bool BoundedSearch::find(const World& world, CellIndex start) {
  clear();
  int total = world.estimate(start);
  push(total, nodeOf(start), kRoot);
  for (std::size_t empty_in_a_row = 0; empty_in_a_row < kBuckets; ++total) {
    std::uint16_t& bucket = buckets_[static_cast<std::size_t>(total) % kBuckets];
    empty_in_a_row = bucket == kNone ? empty_in_a_row + 1 : 0;
    while (bucket != kNone) {
      const int node = pop(&bucket);
      if (node < 0) continue;
      const CellIndex place{node % kSide, node / kSide};
      if (world.isTarget(place)) {
        cost_ = total;
        target_ = node;
        return true;
      }
      if (atEdge(place)) continue;
      const int cost = total - world.estimate(place);
      world.expand(place, [&](std::size_t direction, int length) {
        const CellIndex next = cellBeside(place, static_cast<int>(direction));
        if (reachedBy(nodeOf(next)) != kUnreached) return;
        push(cost + length + world.estimate(next), nodeOf(next), direction);
      });
    }
  }
  return false;
}

inline void BoundedSearch::clear() {
  std::fill(reached_by_.begin(), reached_by_.end(), std::uint8_t{kUnreached << 4 | kUnreached});
  free_ = kNone;
  fresh_ = 0;
  buckets_.fill(kNone);
}

inline void BoundedSearch::setReachedBy(int node, unsigned direction) {
  std::uint8_t& both = reached_by_[static_cast<std::size_t>(node / 2)];
  both = static_cast<std::uint8_t>((both & (node % 2 == 0 ? 0xf0u : 0x0fu)) | direction << (node % 2 * 4));
}

inline void BoundedSearch::push(int total, int node, std::size_t direction) {
  if (free_ == kNone && fresh_ == kMostOpen) return;
  std::uint16_t& bucket = buckets_[static_cast<std::size_t>(total) % kBuckets];
  const auto entry = free_ != kNone ? free_ : static_cast<std::uint16_t>(fresh_++);
  OpenNode& open = open_[entry];
  if (entry == free_) free_ = open.next;
  open.node = static_cast<std::uint32_t>(node) & 0xffffu;
  open.direction = static_cast<std::uint32_t>(direction) & 0xfu;
  open.next = bucket & 0xfffu;
  bucket = entry;
}

inline int BoundedSearch::pop(std::uint16_t* bucket) {
  const std::uint16_t entry = *bucket;
  OpenNode& open = open_[entry];
  *bucket = static_cast<std::uint16_t>(open.next);
  open.next = free_ & 0xfffu;
  free_ = entry;
  const int node = static_cast<int>(open.node);
  if (reachedBy(node) != kUnreached) return -1;
  setReachedBy(node, open.direction);
  ++expanded_;
  return node;
}

inline void BoundedSearch::path(std::size_t most, std::vector<std::uint8_t>* directions) const {
  const auto before = [&](int later) { return later - nodeOf(kGridRaySteps[reachedBy(later)]); };
  directions->clear();
  std::size_t steps = 0;
  for (int at = target_; reachedBy(at) != kRoot; at = before(at)) ++steps;
  for (int at = target_; reachedBy(at) != kRoot; at = before(at)) {
    if (--steps < most) directions->push_back(reachedBy(at));
  }
  std::reverse(directions->begin(), directions->end());
}

}  // namespace lstm_planner
