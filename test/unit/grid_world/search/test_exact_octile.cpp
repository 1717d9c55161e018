#include <gtest/gtest.h>

#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner::test_exact_octile {
namespace {

TEST(OctileDistance, CountsStraightAndDiagonalSteps) {
  EXPECT_TRUE(octileDistance({2, 3}, {9, 1}) == (OctileDistance{5, 2}));
  EXPECT_TRUE(octileDistance({9, 1}, {2, 3}) == (OctileDistance{5, 2}));
  EXPECT_DOUBLE_EQ(octileDistance({0, 0}, {3, 4}).length(), 1.0 + 3.0 * 1.4142135623730951);
}

TEST(OctileDistance, TellsStraightFromDiagonalWhereTheyAreNearlyTheSame) {
  // Numerators and denominators of the best fractions for sqrt(2), in turn below and above it.
  EXPECT_TRUE((OctileDistance{7, 0} < OctileDistance{0, 5}));
  EXPECT_FALSE((OctileDistance{17, 0} < OctileDistance{0, 12}));
  EXPECT_TRUE((OctileDistance{0, 543339720} < OctileDistance{768398401, 0}));
  EXPECT_TRUE((OctileDistance{318281039, 0} < OctileDistance{0, 225058681}));
}

TEST(OctileDistance, IsNotLessThanItself) {
  EXPECT_FALSE((OctileDistance{4, 5} < OctileDistance{4, 5}));
  EXPECT_TRUE((OctileDistance{4, 5} < OctileDistance{5, 5}));
  EXPECT_TRUE((OctileDistance{4, 4} < OctileDistance{4, 5}));
  EXPECT_TRUE((OctileDistance{5, 4} < OctileDistance{4, 5}));
}

TEST(OctileDistance, FallsWithEachStepOfAStaircaseToTheGoal) {
  // What makes boundary following certain: straight steps towards the goal are enough.
  for (int column = 0; column <= 30; ++column) {
    for (int row = 0; row <= 30; ++row) {
      if (column > 0) {
        EXPECT_TRUE(octileDistance({column - 1, row}, {0, 0}) < octileDistance({column, row}, {0, 0}));
      }
      if (row > 0) {
        EXPECT_TRUE(octileDistance({column, row - 1}, {0, 0}) < octileDistance({column, row}, {0, 0}));
      }
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_exact_octile
