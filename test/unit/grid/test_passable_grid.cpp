#include <gtest/gtest.h>

#include <stdexcept>

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner::test_passable_grid {
namespace {

TEST(PassableGrid, RefusesAbsurdSizes) {
  EXPECT_THROW(PassableGrid(0, 5, true), std::invalid_argument);
  EXPECT_THROW(PassableGrid(5, -1, true), std::invalid_argument);
  EXPECT_THROW(PassableGrid(1 << 20, 1 << 20, true), std::invalid_argument);
}

TEST(PassableGrid, ADiagonalMoveNeedsBothItsSidesUnlessCornersMayBeCut) {
  PassableGrid grid(3, 3, true);
  grid.set({2, 1}, false);
  EXPECT_FALSE(movePossible(grid, {1, 1}, 1, CornerCutting::kForbidden));
  EXPECT_TRUE(movePossible(grid, {1, 1}, 1, CornerCutting::kAllowed));
  EXPECT_TRUE(movePossible(grid, {1, 1}, 3, CornerCutting::kForbidden));
}

}  // namespace
}  // namespace lstm_planner::test_passable_grid
