#include <gtest/gtest.h>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/world/range_table.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_range_table {
namespace {

TEST(RangeTable, CountsStepsToTheFirstBlockedCellUpToTheCap) {
  PassableGrid grid(200, 200, true);
  grid.set({104, 100}, false);
  grid.set({101, 101}, false);
  const RangeTable table(grid);
  EXPECT_EQ(table.at({100, 100}), (GridRanges{4, 1, 50, 50, 50, 50, 50, 50}));
  EXPECT_EQ(table.at({0, 0}), (GridRanges{50, 50, 50, 1, 1, 1, 1, 1}));
  EXPECT_EQ(table.at({55, 100})[0], 49);
  EXPECT_EQ(table.at({54, 100})[0], 50);
  EXPECT_EQ(table.at({53, 100})[0], 50);
}

TEST(RangeTable, SaysTheSameAboutMovesAsTheMap) {
  // All 256 neighbourhoods of a cell.
  for (int blocked = 0; blocked < 256; ++blocked) {
    PassableGrid grid(5, 5, true);
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      grid.set(cellBeside({2, 2}, direction), (blocked >> direction) % 2 == 0);
    }
    const GridRanges ranges = RangeTable(grid).at({2, 2});
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      for (const CornerCutting rule : {CornerCutting::kForbidden, CornerCutting::kAllowed}) {
        EXPECT_EQ(movePossible(ranges, direction, rule), movePossible(grid, {2, 2}, direction, rule));
      }
    }
  }
}

TEST(RangeTable, HoldsWhatTheRaysSense) {
  PassableGrid grid(130, 90, true);
  Random random(5);
  for (int i = 0; i < 600; ++i) {
    grid.set({static_cast<int>(uniformIndex(random, 130)), static_cast<int>(uniformIndex(random, 90))}, false);
  }
  const RangeTable table(grid);
  for (const CellIndex cell : grid.cells()) {
    const GridRanges expected = grid.passable(cell) ? senseRanges(grid, cell) : GridRanges{};
    ASSERT_EQ(table.at(cell), expected) << cell.column << ", " << cell.row;
  }
}

}  // namespace
}  // namespace lstm_planner::test_range_table
