#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/grid_world/search/grid_distances.hpp"

namespace lstm_planner::test_grid_distances {
namespace {

TEST(GridDistances, AreOctileWhereNothingIsInTheWay) {
  const PassableGrid grid(20, 10, true);
  const GridDistances distances(grid, {2, 3}, CornerCutting::kForbidden);
  EXPECT_FLOAT_EQ(distances.at({2, 3}), 0.0f);
  EXPECT_FLOAT_EQ(distances.at({12, 7}), static_cast<float>(6.0 + 4.0 * std::sqrt(2.0)));
}

TEST(GridDistances, GoAroundACornerUnlessItMayBeCut) {
  PassableGrid grid(3, 3, true);
  grid.set({1, 0}, false);
  EXPECT_FLOAT_EQ(GridDistances(grid, {0, 0}, CornerCutting::kForbidden).at({1, 1}), 2.0f);
  EXPECT_FLOAT_EQ(GridDistances(grid, {0, 0}, CornerCutting::kAllowed).at({1, 1}), std::sqrt(2.0f));
}

TEST(GridDistances, AreInfiniteOutsideInWallsAndBehindThem) {
  PassableGrid grid(5, 3, true);
  for (int row = 0; row < 3; ++row) grid.set({2, row}, false);
  const GridDistances distances(grid, {0, 0}, CornerCutting::kAllowed);
  EXPECT_TRUE(std::isinf(distances.at({4, 0})));
  EXPECT_TRUE(std::isinf(distances.at({2, 1})));
  EXPECT_TRUE(std::isinf(distances.at({-1, 0})));
  EXPECT_TRUE(std::isinf(GridDistances(grid, {2, 1}, CornerCutting::kAllowed).at({0, 0})));
}

TEST(GridDistances, AreInfiniteWhereFloatsNoLongerTellMovesApart) {
  constexpr int kSide = 5801;  // a path of more than 2^24 cells winds through it: 5802 in every second row
  PassableGrid grid(kSide, kSide, true);
  for (int row = 1; row < kSide; row += 2) {
    for (int column = 0; column < kSide; ++column) grid.set({column, row}, column == (row % 4 == 1 ? kSide - 1 : 0));
  }
  const GridDistances distances(grid, {0, 0}, CornerCutting::kForbidden);
  constexpr int kRow = 2 * 2891;  // through which it leads back
  const int column = kSide - 1 - (16777216 - 2891 * 5802);
  EXPECT_EQ(distances.at({column + 1, kRow}), 16777215.0f);
  EXPECT_TRUE(std::isinf(distances.at({column, kRow})));
}

}  // namespace
}  // namespace lstm_planner::test_grid_distances
