#include <gtest/gtest.h>

#include "lstm_planner/drive/local_map/obstacle_window.hpp"
#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner::test_obstacle_window {
namespace {

TEST(ObstacleWindow, ACellIsOccupiedAsLongAsOneOfItsSquaresIs) {
  ObstacleWindow window(8.0, 0.05);
  window.moveTo({});
  EXPECT_EQ(window.side(), 40);
  const Square first{41, 42};
  const Square second{43, 40};
  const int cell = window.set(first, true);
  EXPECT_EQ(cell, 10 * window.side() + 10);
  EXPECT_EQ(window.set(second, true), cell);
  EXPECT_TRUE(window.isOccupied(first));
  window.set(first, false);
  EXPECT_FALSE(window.isOccupied(first));
  EXPECT_TRUE(window.cells().test(10, 10));
  window.set(second, false);
  EXPECT_FALSE(window.cells().test(10, 10));
}

TEST(ObstacleWindow, KnowsWhereItsSquaresAndCellsAre) {
  ObstacleWindow window(8.0, 0.05);
  window.moveTo({10.0, -3.0, 0.0});
  for (const int cell : {0, 39, 820, 1599}) {
    EXPECT_EQ(window.cellAt(window.centerOf(cell)), cell);
    for (int square = 0; square < ObstacleWindow::kCellSquares; ++square) {
      EXPECT_EQ(window.cellAt(window.centerOf(window.squareOf(cell, square))), cell) << square;
    }
  }
  EXPECT_EQ(window.cellAt({20.0, -3.0}), -1);
}

TEST(ObstacleWindow, MovesAlongWithTheRobotAndKeepsWhatIsInside) {
  ObstacleWindow window(8.0, 0.05);
  EXPECT_TRUE(window.moveTo({}));
  EXPECT_FALSE(window.moveTo({0.5, 0.0, 0.0})) << "not far enough";
  window.set(window.squareOf(window.cellAt({1.1, 1.1}), 5), true);
  window.set(window.squareOf(window.cellAt({-3.5, 0.1}), 5), true);
  EXPECT_TRUE(window.moveTo({2.0, 0.0, 0.0}));
  const auto isCellOccupied = [&](const Point2& place) {
    const int cell = window.cellAt(place);
    return window.cells().test(cell % window.side(), cell / window.side());
  };
  EXPECT_TRUE(isCellOccupied({1.1, 1.1}));
  EXPECT_EQ(window.cellAt({-3.5, 0.1}), -1);
  window.clear();
  window.moveTo({});
  EXPECT_FALSE(isCellOccupied({1.1, 1.1}));
  EXPECT_FALSE(isCellOccupied({-3.5, 0.1}));
}

TEST(ObstacleWindow, AKeyIsASquare) {
  const Square square = squareOf(keyOf({1234, 567}));
  EXPECT_EQ(square.column, 1234);
  EXPECT_EQ(square.row, 567);
}

TEST(ObstacleWindow, FindsTheSmallestSquaresAsFarAwayAsPosesAreUsed) {
  for (const double far : {-kFarthestPose, 0.0, kFarthestPose}) {
    ObstacleWindow window(10.0, 0.005);
    window.moveTo({far, far, 0.0});
    const Square square = window.squareAt({far + 0.5, far - 0.5});
    ASSERT_TRUE(window.contains(square)) << far;
    EXPECT_NEAR(window.centerOf(square).x - far, 0.5, 0.005);
    EXPECT_NEAR(window.centerOf(square).y - far, -0.5, 0.005);
  }
}

}  // namespace
}  // namespace lstm_planner::test_obstacle_window
