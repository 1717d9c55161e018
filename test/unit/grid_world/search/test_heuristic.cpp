#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lstm_planner/grid_world/search/heuristic.hpp"

namespace lstm_planner::test_heuristic {
namespace {

double cells(Heuristic heuristic, CellIndex from, CellIndex to) {
  return static_cast<double>(estimateCost(heuristic, from, to)) / static_cast<double>(kStraightCost);
}

TEST(Heuristic, FollowsTheThesisEquations) {
  const CellIndex from{10, 3};
  const CellIndex to{7, 7};                                           // 3 columns, 4 rows: a straight line of 5
  constexpr double kUnit = 2.0 / static_cast<double>(kStraightCost);  // rounded down to a unit
  EXPECT_NEAR(cells(Heuristic::kManhattan, from, to), 7.0, kUnit);
  EXPECT_NEAR(cells(Heuristic::kChebyshev, from, to), 4.0, kUnit);
  EXPECT_NEAR(cells(Heuristic::kOctile, from, to), 1.0 + 3.0 * std::sqrt(2.0), kUnit);
  EXPECT_NEAR(cells(Heuristic::kEuclidean, from, to), 5.0, kUnit);
  EXPECT_NEAR(cells(Heuristic::kScaledEuclidean, from, to), 125.0, kUnit);
}

TEST(Heuristic, CountsMovesAsTheyCost) {
  const MoveCosts costs = moveCosts(2.0, 3.0);
  const auto cells = [&](Heuristic heuristic) {
    return static_cast<double>(estimateCost(heuristic, {10, 3}, {7, 7}, costs)) / static_cast<double>(kStraightCost);
  };
  EXPECT_EQ(cells(Heuristic::kManhattan), 2.0 * 7.0) << "Eq. 1.3";
  EXPECT_EQ(cells(Heuristic::kOctile), 2.0 * 7.0 + (3.0 - 2.0 * 2.0) * 3.0) << "Eq. 1.4";
  EXPECT_EQ(cells(Heuristic::kChebyshev), 2.0 * 4.0) << "Eq. 1.4 with d = c";
  EXPECT_NEAR(cells(Heuristic::kEuclidean), 5.0, 1e-6);
}

TEST(Heuristic, IsNeverLongerThanThePathWhereItIsAdmissible) {
  struct Case {
    Heuristic heuristic;
    bool admissible;
  };
  const Case cases[] = {{Heuristic::kManhattan, false},
                        {Heuristic::kChebyshev, true},
                        {Heuristic::kOctile, true},
                        {Heuristic::kEuclidean, true},
                        {Heuristic::kScaledEuclidean, false}};
  for (const auto& [heuristic, admissible] : cases) {
    bool never_longer = true;
    for (int column = 0; column < 60; ++column) {
      for (int row = 0; row < 60; ++row) {
        const MoveCost path = estimateCost(Heuristic::kOctile, {0, 0}, {column, row});
        never_longer = never_longer && estimateCost(heuristic, {0, 0}, {column, row}) <= path;
      }
    }
    EXPECT_EQ(never_longer, admissible) << static_cast<int>(heuristic);
  }
}

TEST(Heuristic, FitsItsTypeOnTheLongestGrid) {
  constexpr int kLongest = (1 << 26) - 1;
  const MoveCost longest_path = kDiagonalCost * (kLongest + 1);
  EXPECT_LT(estimateCost(Heuristic::kScaledEuclidean, {0, 0}, {kLongest, 0}),
            std::numeric_limits<MoveCost>::max() - longest_path);
}

}  // namespace
}  // namespace lstm_planner::test_heuristic
