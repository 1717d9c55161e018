#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "grid_world/agent/block_patch.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner::test_block_patch {
namespace {

constexpr int kSide = 16;
using Cells = std::array<std::array<bool, kSide>, kSide>;

/// Depth first, cell by cell.
bool leadsTo(Cells open, CellIndex cell, CellIndex to) {
  const auto inside = [](int i) { return i >= 0 && i < kSide; };
  if (!inside(cell.column) || !inside(cell.row)) return false;
  bool& is_open = open[static_cast<std::size_t>(cell.row)][static_cast<std::size_t>(cell.column)];
  if (!is_open) return false;
  std::vector<CellIndex> left = {cell};
  is_open = false;
  while (!left.empty()) {
    const CellIndex now = left.back();
    left.pop_back();
    if (now == to) return true;
    for (const CellIndex step : {CellIndex{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      const CellIndex next{now.column + step.column, now.row + step.row};
      if (!inside(next.column) || !inside(next.row)) continue;
      bool& free = open[static_cast<std::size_t>(next.row)][static_cast<std::size_t>(next.column)];
      if (free) left.push_back(next);
      free = false;
    }
  }
  return false;
}

BlockPatch patchOf(const Cells& cells) {
  BlockPatch patch;
  for (int block = 0; block < 16; ++block) {
    unsigned bits = 0;
    for (int i = 0; i < 16; ++i) {
      const auto row = static_cast<std::size_t>(block / 4 * 4 + i / 4);
      const auto column = static_cast<std::size_t>(block % 4 * 4 + i % 4);
      bits |= (cells[row][column] ? 1u : 0u) << i;
    }
    patch.add(bits, {block % 4, block / 4});
  }
  return patch;
}

TEST(BlockPatch, LeadsWhereverStraightMovesBetweenOpenCellsLead) {
  Random random(4);
  int found = 0;
  constexpr int kPatches = 400;
  for (int patch = 0; patch < kPatches; ++patch) {
    Cells open{};
    for (auto& row : open) {
      for (bool& cell : row) cell = uniform(random) < 0.62;
    }
    const auto draw = [&] { return static_cast<int>(uniformIndex(random, kSide)); };
    const CellIndex from{draw(), draw()};
    const CellIndex to{draw(), draw()};
    const auto only = [](CellIndex cell) {
      Cells cells{};
      cells[static_cast<std::size_t>(cell.row)][static_cast<std::size_t>(cell.column)] = true;
      return patchOf(cells);
    };
    const bool expected = leadsTo(open, from, to);
    EXPECT_EQ(only(from).leadsTo(only(to), patchOf(open)), expected);
    found += expected ? 1 : 0;
  }
  EXPECT_GT(found, kPatches / 10);
  EXPECT_LT(found, kPatches * 9 / 10);
}

}  // namespace
}  // namespace lstm_planner::test_block_patch
