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

}  // namespace
}  // namespace lstm_planner::test_grid_distances
