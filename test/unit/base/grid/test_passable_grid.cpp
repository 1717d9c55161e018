#include <gtest/gtest.h>

#include <stdexcept>

#include "lstm_planner/base/grid/passable_grid.hpp"

namespace lstm_planner {
namespace {

TEST(PassableGrid, RefusesAbsurdSizes) {
  EXPECT_THROW(PassableGrid(0, 5, true), std::invalid_argument);
  EXPECT_THROW(PassableGrid(5, -1, true), std::invalid_argument);
  EXPECT_THROW(PassableGrid(1 << 20, 1 << 20, true), std::invalid_argument);
}

TEST(PassableGrid, RangesCountStepsToTheFirstBlockedCellUpToTheCap) {
  PassableGrid grid(200, 200, true);
  grid.set({104, 100}, false);
  grid.set({101, 101}, false);
  const GridRanges ranges = senseRanges(grid, {100, 100});
  EXPECT_EQ(ranges, (GridRanges{4, 1, 50, 50, 50, 50, 50, 50}));
  EXPECT_EQ(senseRanges(grid, {0, 0}), (GridRanges{50, 50, 50, 1, 1, 1, 1, 1}));
}

TEST(PassableGrid, WhatWasSensedSaysTheSameAboutMovesAsTheMap) {
  // All 256 neighbourhoods of a cell.
  for (int blocked = 0; blocked < 256; ++blocked) {
    PassableGrid grid(5, 5, true);
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      grid.set(cellBeside({2, 2}, direction), (blocked >> direction) % 2 == 0);
    }
    const GridRanges ranges = senseRanges(grid, {2, 2});
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      for (const CornerCutting rule : {CornerCutting::kForbidden, CornerCutting::kAllowed}) {
        EXPECT_EQ(movePossible(ranges, direction, rule), movePossible(grid, {2, 2}, direction, rule));
      }
    }
  }
}

TEST(PassableGrid, ADiagonalMoveNeedsBothItsSidesUnlessCornersMayBeCut) {
  PassableGrid grid(3, 3, true);
  grid.set({2, 1}, false);
  EXPECT_FALSE(movePossible(grid, {1, 1}, 1, CornerCutting::kForbidden));
  EXPECT_TRUE(movePossible(grid, {1, 1}, 1, CornerCutting::kAllowed));
  EXPECT_TRUE(movePossible(grid, {1, 1}, 3, CornerCutting::kForbidden));
}

}  // namespace
}  // namespace lstm_planner
