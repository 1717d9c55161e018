#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lstm_planner/drive/perception/costmap_obstacles.hpp"

namespace lstm_planner::test_costmap_obstacles {
namespace {

constexpr unsigned char kInscribed = 253;
constexpr unsigned char kLethal = 254;
constexpr unsigned char kUnknown = 255;
constexpr double kResolution = 0.05;  // m
constexpr double kReach = 2.0;        // m
constexpr double kHalf = 0.5 * kResolution;

class CostmapObstaclesTest : public ::testing::Test {
 protected:
  CostmapObstaclesTest() : costs_(120 * 120, 0) {
    grid_.costs = costs_.data();
    grid_.columns = 120;
    grid_.rows = 120;
    grid_.resolution = kResolution;
    grid_.origin = {-3.0, -3.0};
    grid_.inscribed_radius = 0.17;
  }

  /// At the cell's middle, in the costmap's frame.
  void mark(double x, double y, unsigned char cost = kLethal) {
    const int column = static_cast<int>(std::floor((x - grid_.origin.x) / kResolution));
    const int row = static_cast<int>(std::floor((y - grid_.origin.y) / kResolution));
    costs_[static_cast<std::size_t>(row * grid_.columns + column)] = cost;
  }
  void markSquare(const Point2& low, const Point2& high) {
    for (double x = low.x + kHalf; x < high.x; x += kResolution) {
      for (double y = low.y + kHalf; y < high.y; y += kResolution) mark(x, y);
    }
  }

  const std::vector<Point2>& find(const Pose2& base = {}, const std::vector<Point2>& returns = {}) {
    found_ = costmapObstacles(grid_, base, returns, kReach);
    return found_;
  }

  std::vector<unsigned char> costs_;
  CostGrid grid_;
  std::vector<Point2> found_;
};

TEST_F(CostmapObstaclesTest, FindsALethalCellInTheFrameOfTheRobot) {
  mark(1.0 + kHalf, 0.5 + kHalf);
  ASSERT_EQ(find({1.0 + kHalf, 0.0, M_PI_2}).size(), 1u);
  EXPECT_NEAR(found_[0].x, 0.5 + kHalf, 1e-9);
  EXPECT_NEAR(found_[0].y, 0.0, 1e-9);
}

TEST_F(CostmapObstaclesTest, CostsBelowAnObstaclesAndUnknownCellsAreNone) {
  for (int cost = 0; cost < 256; ++cost) {
    if (cost != kInscribed && cost != kLethal) mark(-2.9 + 0.02 * cost, 0.1, static_cast<unsigned char>(cost));
  }
  std::fill(costs_.begin(), costs_.begin() + 4000, kUnknown);
  EXPECT_TRUE(find().empty());
}

TEST_F(CostmapObstaclesTest, WhatTheScanShowsIsLeftToTheScan) {
  mark(1.0 + kHalf, kHalf);
  const double beside = kResolution;  // the return is in the cell next to it
  EXPECT_TRUE(find({}, {{1.0 + kHalf, kHalf}}).empty());
  EXPECT_TRUE(find({}, {{1.0 + kHalf + beside, kHalf - beside}}).empty());
  EXPECT_EQ(find({}, {{1.0 + kHalf + 2.0 * beside, kHalf}}).size(), 1u);
  // Seen from another pose the return is somewhere else in the base frame.
  EXPECT_TRUE(find({1.0 + kHalf, -1.0, M_PI_2}, {{1.0 + kHalf, 0.0}}).empty());
}

TEST_F(CostmapObstaclesTest, WhatIsOutOfReachOrOffTheMapIsNotThere) {
  mark(2.5, 0.0);
  EXPECT_TRUE(find().empty());
  EXPECT_EQ(find({1.0, 0.0, 0.0}).size(), 1u);
  EXPECT_TRUE(find({100.0, 100.0, 0.0}).empty());
  EXPECT_TRUE(find({std::nan(""), 0.0, 0.0}).empty());
}

TEST_F(CostmapObstaclesTest, OfAnInflatedObstacleOnlyTheLethalCellCounts) {
  mark(1.0 + kHalf, kHalf);
  for (double x = 0.85; x < 1.2; x += kResolution) {
    for (double y = -0.15; y < 0.2; y += kResolution) {
      if (std::hypot(x - 1.0, y) < grid_.inscribed_radius && std::hypot(x - 1.0, y) > 0.01) {
        mark(x + kHalf, y + kHalf, kInscribed);
      }
    }
  }
  EXPECT_EQ(find().size(), 1u);
}

TEST_F(CostmapObstaclesTest, AnInflatedCellWithinReachMayHaveItsReasonBeyond) {
  mark(1.9 + kHalf, kHalf, kInscribed);
  mark(2.05 + kHalf, kHalf);
  EXPECT_TRUE(find().empty());
}

TEST_F(CostmapObstaclesTest, FineCellsAroundALargeRobotAreInflatedTooAndNoObstacles) {
  grid_.resolution = 0.01;
  grid_.inscribed_radius = 0.5;
  for (int row = 0; row < grid_.rows; ++row) {
    for (int column = 0; column < grid_.columns; ++column) {
      const double distance = std::hypot(column - 60, row - 60) * grid_.resolution;
      if (distance <= grid_.inscribed_radius) costs_[static_cast<std::size_t>(row * 120 + column)] = kInscribed;
    }
  }
  costs_[60 * 120 + 60] = kLethal;
  EXPECT_EQ(find({-2.4, -2.4, 0.0}).size(), 1u);
}

TEST_F(CostmapObstaclesTest, AnInscribedCellFarFromAllLethalOnesIsAnObstacle) {
  mark(1.0 + kHalf, kHalf, kInscribed);
  EXPECT_EQ(find().size(), 1u);
}

TEST_F(CostmapObstaclesTest, AZoneIsItsRimAndWhatIsNear) {
  markSquare({1.0, -0.5}, {2.0, 0.5});
  const std::size_t cells = 20 * 20;
  const std::size_t rim = 4 * 19;
  EXPECT_LE(find().size(), rim) << "none of it is within 0.5 m";
  EXPECT_GE(found_.size(), rim / 2) << "the reach ends within it";
  find({1.5, 0.0, 0.0});
  EXPECT_GT(found_.size(), rim) << "who stands in it must notice";
  EXPECT_LT(found_.size(), cells);
  EXPECT_TRUE(std::any_of(found_.begin(), found_.end(),
                          [](const Point2& place) { return std::hypot(place.x, place.y) < kResolution; }));
}

TEST_F(CostmapObstaclesTest, ALargeCellIsSeveralPoints) {
  grid_.resolution = 0.2;
  grid_.origin = {-12.0, -12.0};
  costs_[60 * 120 + 65] = kLethal;  // from (1, 0) to (1.2, 0.2)
  ASSERT_EQ(find().size(), 16u);
  for (const Point2& place : found_) {
    EXPECT_NEAR(place.x, 1.1, 0.1);
    EXPECT_NEAR(place.y, 0.1, 0.1);
  }
}

TEST_F(CostmapObstaclesTest, WithoutCellsThereIsNothing) {
  grid_ = {};
  EXPECT_TRUE(find().empty());
}

}  // namespace
}  // namespace lstm_planner::test_costmap_obstacles
