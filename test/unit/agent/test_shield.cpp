#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/agent/shield.hpp"
#include "lstm_planner/simulation/random.hpp"

namespace lstm_planner {
namespace {

constexpr double kRadius = 0.25;
constexpr double kHardMargin = 0.03125;  // with 0.25 exact in binary
constexpr double kClearance = 0.25;
constexpr double kReach = 2.5;
constexpr double kLimit = 2.0;

double freeDistanceTo(const std::vector<Point2>& obstacles, double direction = 0.0, double clearance = kClearance) {
  Shield shield(kRadius, kHardMargin, kReach);
  shield.show(obstacles);
  return shield.freeDistance({}, direction, kLimit, clearance);
}

TEST(Shield, StopsWhereTheGrownDiscMeetsAPointAhead) {
  EXPECT_DOUBLE_EQ(freeDistanceTo({{1.5, 0.0}}), 1.0);
  // The disc of 0.5 m meets a point 0.3 m aside when its centre is 0.4 m before it.
  EXPECT_NEAR(freeDistanceTo({{1.5, 0.3}}), 1.1, 1e-12);
  EXPECT_NEAR(freeDistanceTo({{1.5, -0.3}}), 1.1, 1e-12);
  const Point2 turned = pointAlong(Point2{}, 2.0, 1.5);
  EXPECT_NEAR(freeDistanceTo({turned}, 2.0), 1.0, 1e-12);
}

TEST(Shield, TakesTheNearestOfAllObstaclesAndTheLimit) {
  EXPECT_DOUBLE_EQ(freeDistanceTo({{2.0, 0.0}, {1.0, 0.0}, {1.5, 0.0}}), 0.5);
  EXPECT_DOUBLE_EQ(freeDistanceTo({}), kLimit);
  EXPECT_DOUBLE_EQ(freeDistanceTo({{2.6, 0.0}}), kLimit);  // out of reach
}

TEST(Shield, LetsADiscPassThatJustTouches) {
  EXPECT_DOUBLE_EQ(freeDistanceTo({{1.0, 0.5}}), kLimit);
  EXPECT_LT(freeDistanceTo({{1.0, 0.4999}}), 1.0);
}

TEST(Shield, IgnoresWhatLiesBehindOrAbeam) {
  EXPECT_DOUBLE_EQ(freeDistanceTo({{-0.3, 0.0}}), kLimit);
  EXPECT_DOUBLE_EQ(freeDistanceTo({{0.0, 0.3}}), kLimit);
}

TEST(Shield, MeasuresFromWhereItIsAsked) {
  Shield shield(kRadius, kHardMargin, kReach);
  shield.show({{1.0, 1.0}});
  EXPECT_DOUBLE_EQ(shield.freeDistance({0.0, 1.0}, 0.0, kLimit, kClearance), 0.5);
}

TEST(Shield, LetsARobotInTheClearancePassButNotApproach) {
  EXPECT_LE(freeDistanceTo({{0.4, 0.0}}), 0.002);
  EXPECT_DOUBLE_EQ(freeDistanceTo({{0.02, 0.4}}), kLimit);  // passing brings it nearer by half a millimetre
}

TEST(Shield, NeverComesNearerThanTheClearanceOrThanItIs) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Point2 obstacle{uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5)};
    const double now = distanceBetween(Point2{}, obstacle);
    const double direction = uniform(random, -M_PI, M_PI);
    const double free = freeDistanceTo({obstacle}, direction);
    const double allowed = std::min(kRadius + kClearance, now - 0.001);
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
      ASSERT_GE(distanceBetween(pointAlong(Point2{}, direction, share * free), obstacle), allowed - 1e-9);
    }
  }
}

TEST(Shield, OnlyLetsTheRobotGoAwayInsideTheHardMargin) {
  const std::vector<Point2> obstacle = {{0.28, 0.0}};  // 0.03 m before the footprint
  for (int degrees = -180; degrees < 180; degrees += 10) {
    const bool away = std::abs(degrees) >= 100;
    if (std::abs(degrees) == 90) continue;  // abeam but for rounding
    EXPECT_EQ(freeDistanceTo(obstacle, degreesToRadians(degrees)), away ? kLimit : 0.0) << degrees;
  }
}

TEST(Shield, TakesTheSmallerOfClearanceAndHardMarginAsHard) {
  EXPECT_GT(freeDistanceTo({{0.28, 0.0}}, 0.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(freeDistanceTo({{0.28, 0.0}}, 0.0, kHardMargin), 0.0);
}

TEST(Shield, KeepsTheHardMarginOfANoisyWallForTenThousandSteps) {
  constexpr double kWallAt = 2.0;
  const double noise = 0.01;
  Random random(7);
  Shield shield(kRadius, kHardMargin, kReach);
  double x = 0.0;
  double nearest = kWallAt;
  for (int step = 0; step < 10000; ++step) {
    std::vector<Point2> seen;
    for (int beam = -60; beam <= 60; ++beam) {
      const double angle = degreesToRadians(beam);
      seen.push_back(pointAlong(Point2{}, angle, (kWallAt - x) / std::cos(angle) + noise * normal(random)));
    }
    shield.show(seen);
    const double direction = uniform(random, -M_PI_2, M_PI_2);  // never away: only the shield holds it back
    x += std::cos(direction) * shield.freeDistance({}, direction, 0.4, 0.07);
    nearest = std::min(nearest, kWallAt - x - kRadius);
  }
  EXPECT_GE(nearest, kHardMargin);
  EXPECT_LT(nearest, 0.07);  // it did come near
}

TEST(Shield, TellsTheGapToTheNearestReturn) {
  Shield shield(kRadius, kHardMargin, kReach);
  EXPECT_DOUBLE_EQ(shield.gap({}), kReach);
  shield.show({{2.0, 0.0}, {0.0, -1.0}});
  EXPECT_DOUBLE_EQ(shield.gap({}), 0.75);
  EXPECT_DOUBLE_EQ(shield.gap({1.5, 0.0}), 0.25);
}

TEST(Shield, ForgetsTheScanBefore) {
  Shield shield(kRadius, kHardMargin, kReach);
  shield.show({{1.0, 0.0}});
  shield.show({});
  EXPECT_DOUBLE_EQ(shield.freeDistance({}, 0.0, kLimit, kClearance), kLimit);
}

TEST(Shield, RefusesADiscThatItCannotWatch) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Shield(0.0, 0.03, 2.5), std::invalid_argument);
  EXPECT_THROW(Shield(0.2, -0.01, 2.5), std::invalid_argument);
  EXPECT_THROW(Shield(0.2, 0.03, 0.23), std::invalid_argument);
  EXPECT_THROW(Shield(nan, 0.03, 2.5), std::invalid_argument);
  EXPECT_THROW(Shield(0.2, 0.03, nan), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner
