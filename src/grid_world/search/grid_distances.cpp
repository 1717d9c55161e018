#include "lstm_planner/grid_world/search/grid_distances.hpp"

#include <array>
#include <limits>
#include <vector>

namespace lstm_planner {
namespace {

constexpr float kUnreachable = std::numeric_limits<float>::infinity();

/// No move is longer than sqrt(2): three buckets of width 1 hold all that is open.
constexpr std::size_t kBuckets = 3;

/// From here on a float may not become longer by a move, which would come into the bucket that is being emptied.
constexpr float kTooLong = 16777216.0f;  // 2^24 cells

}  // namespace

GridDistances::GridDistances(const PassableGrid& grid, CellIndex goal, CornerCutting corner_cutting)
    : lengths_(grid.columns(), grid.rows(), kUnreachable) {
  if (!grid.passable(goal)) return;
  struct Open {
    CellIndex cell;
    float length;
  };
  std::array<std::vector<Open>, kBuckets> buckets;
  lengths_[goal] = 0.0f;
  buckets[0].push_back({goal, 0.0f});
  std::size_t empty_in_a_row = 0;
  for (std::size_t bucket = 0; empty_in_a_row < kBuckets; ++bucket) {
    std::vector<Open>& open = buckets[bucket % kBuckets];
    empty_in_a_row = open.empty() ? empty_in_a_row + 1 : 0;
    for (const Open& current : open) {
      if (current.length > lengths_[current.cell]) continue;
      for (int direction = 0; direction < kGridMoveCount; ++direction) {
        if (!movePossible(grid, current.cell, direction, corner_cutting)) continue;
        const CellIndex cell = cellBeside(current.cell, direction);
        const float length = current.length + static_cast<float>(moveLength(direction));
        float& known = lengths_[cell];
        if (length >= known || length >= kTooLong) continue;
        known = length;
        buckets[static_cast<std::size_t>(length) % kBuckets].push_back({cell, length});
      }
    }
    open.clear();
  }
}

float GridDistances::at(CellIndex cell) const { return lengths_.at(cell, kUnreachable); }

}  // namespace lstm_planner
