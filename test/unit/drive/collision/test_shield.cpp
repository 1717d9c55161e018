#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/drive/collision/shield.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_shield {
namespace {

constexpr double kRadius = 0.25;
constexpr double kHardMargin = 0.03125;  // with 0.25 exact in binary
constexpr double kClearance = 0.25;
constexpr double kReach = 2.5;
constexpr double kLimit = 2.0;

double freeDistanceTo(const std::vector<Point2>& obstacles, double direction = 0.0, double clearance = kClearance) {
  Shield shield(Footprint(kRadius), kHardMargin, kReach);
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
  Shield shield(Footprint(kRadius), kHardMargin, kReach);
  shield.show({{1.0, 1.0}});
  EXPECT_DOUBLE_EQ(shield.freeDistance({0.0, 1.0}, 0.0, kLimit, kClearance), 0.5);
}

TEST(Shield, MovesOnWithTheRobot) {
  Shield shield(Footprint(kRadius), kHardMargin, kReach);
  shield.show({{1.5, 0.0}});
  shield.moveTo({0.25, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(shield.freeDistance({}, 0.0, kLimit, kClearance), 0.75);
  shield.moveTo({0.0, 0.0, M_PI_2});
  EXPECT_NEAR(shield.freeDistance({}, -M_PI_2, kLimit, kClearance), 0.75, 1e-12);
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
  Shield shield(Footprint(kRadius), kHardMargin, kReach);
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
  Shield shield(Footprint(kRadius), kHardMargin, kReach);
  EXPECT_DOUBLE_EQ(shield.gap({}), kReach);
  shield.show({{2.0, 0.0}, {0.0, -1.0}});
  EXPECT_DOUBLE_EQ(shield.gap({}), 0.75);
  EXPECT_DOUBLE_EQ(shield.gap({1.5, 0.0}), 0.25);
}

TEST(Shield, ForgetsTheScanBefore) {
  Shield shield(Footprint(kRadius), kHardMargin, kReach);
  shield.show({{1.0, 0.0}});
  shield.show({});
  EXPECT_DOUBLE_EQ(shield.freeDistance({}, 0.0, kLimit, kClearance), kLimit);
}

double freeArcTo(const std::vector<Point2>& obstacles, double curvature, double limit = kLimit,
                 double clearance = kClearance) {
  Shield shield(Footprint(kRadius), kHardMargin, kReach);
  shield.show(obstacles);
  return shield.freeArc({}, curvature, limit, clearance);
}

TEST(AlongArc, EndsOnTheCircle) {
  const Pose2 quarter = alongArc({1.0, 2.0, 0.0}, 2.0, 0.25 * M_PI);  // radius 0.5 m, to the left
  EXPECT_NEAR(quarter.x, 1.5, 1e-12);
  EXPECT_NEAR(quarter.y, 2.5, 1e-12);
  EXPECT_NEAR(quarter.yaw, M_PI_2, 1e-12);
  const Pose2 straight = alongArc({1.0, 2.0, M_PI_2}, 0.0, 3.0);
  EXPECT_NEAR(straight.x, 1.0, 1e-12);
  EXPECT_NEAR(straight.y, 5.0, 1e-12);
  EXPECT_DOUBLE_EQ(straight.yaw, M_PI_2);
}

TEST(ShieldArc, StopsWhereTheGrownDiscMeetsAPointOnTheCircle) {
  // A quarter of a circle of radius 1 m leads to (1, 1). The chord from there to where the disc of 0.5 m touches the
  // point is 0.5 m long: 2 asin(0.25) of arc.
  EXPECT_NEAR(freeArcTo({{1.0, 1.0}}, 1.0), M_PI_2 - 2.0 * std::asin(0.25), 1e-12);
  EXPECT_NEAR(freeArcTo({{1.0, -1.0}}, -1.0), M_PI_2 - 2.0 * std::asin(0.25), 1e-12);
  EXPECT_DOUBLE_EQ(freeArcTo({{1.0, -1.0}}, 1.0), kLimit);
}

TEST(ShieldArc, LetsADiscPassThatJustTouches) {
  EXPECT_DOUBLE_EQ(freeArcTo({{0.0, 1.0 + 1.5}}, 1.0, 6.0), 6.0);  // 1.5 m from the centre, 0.5 m from the circle
  EXPECT_LT(freeArcTo({{0.0, 1.0 + 1.4999}}, 1.0, 6.0), M_PI);
  EXPECT_DOUBLE_EQ(freeArcTo({{0.0, 1.5}}, 1.0, 6.0), 6.0);  // inside the circle
  EXPECT_LT(freeArcTo({{0.0, 1.5001}}, 1.0, 6.0), M_PI);
}

TEST(ShieldArc, IsTheStraightLineInTheLimit) {
  const std::vector<Point2> obstacles = {{1.5, 0.3}, {1.9, -0.2}};
  const double straight = freeDistanceTo(obstacles);
  EXPECT_DOUBLE_EQ(freeArcTo(obstacles, 0.0), straight);
  for (const double curvature : {1e-10, 1e-8, -1e-8, 1e-6, -1e-6}) {
    EXPECT_NEAR(freeArcTo(obstacles, curvature), straight, 1e-5 * std::abs(curvature) / 1e-6 + 1e-9) << curvature;
  }
}

TEST(ShieldArc, MeasuresFromThePoseThatItIsAskedFor) {
  Shield shield(Footprint(kRadius), kHardMargin, kReach);
  const Pose2 from{0.5, -0.25, 2.0};
  shield.show({toParentFrame(from, {1.0, 1.0})});
  EXPECT_NEAR(shield.freeArc(from, 1.0, kLimit, kClearance), M_PI_2 - 2.0 * std::asin(0.25), 1e-12);
}

TEST(ShieldArc, LetsARobotInTheHardMarginTurnAwayButNotComeBack) {
  // Points 0.03 m before the footprint, at the radius of 0.28 m.
  const Point2 behind = pointAlong(Point2{}, degreesToRadians(-120.0), 0.28);
  const double there = freeArcTo({behind}, 5.0, 4.0);
  EXPECT_GT(there, 1.0);  // nearly once round a circle of 1.26 m
  EXPECT_NEAR(distanceBetween(alongArc({}, 5.0, there), behind), 0.28, 1e-9);
  EXPECT_EQ(freeArcTo({{0.01, -0.28}}, 5.0, 4.0), 0.0);
  EXPECT_DOUBLE_EQ(freeArcTo({{0.0, 0.28}}, 1.0), kLimit);  // abeam, inside a wide circle: nearer than now it never is
  EXPECT_NEAR(freeArcTo({{0.0, 0.28}}, 5.0), 0.0, 1e-9);    // abeam, but the circle is narrow
}

/// Length of the first piece of the arc, stepped through, on which the robot may be; the rule as it is written down.
double steppedFreeArc(const Point2& obstacle, double curvature, double limit) {
  constexpr double kStep = 1e-4;
  const double wanted = kRadius + kClearance;
  const double hard = kRadius + kHardMargin;
  const double now = std::hypot(obstacle.x, obstacle.y);
  if (now <= hard && obstacle.x > 0.0) return 0.0;
  const double allowed = now <= hard ? now : std::max(hard, std::min(wanted, now - 0.001));
  for (double length = kStep; length < limit; length += kStep) {
    if (distanceBetween(alongArc({}, curvature, length), obstacle) < allowed - 1e-9) return length;
  }
  return limit;
}

TEST(ShieldArc, AgreesWithSteppingAlongTheArc) {
  Random random(2);
  int blocked = 0;
  for (int i = 0; i < 3000; ++i) {
    const Point2 obstacle{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
    const double curvature = i % 10 == 0 ? uniform(random, -100.0, 100.0) : uniform(random, -6.0, 6.0);
    const double limit = uniform(random, 0.1, 2.0);
    const double free = freeArcTo({obstacle}, curvature, limit);
    const double stepped = steppedFreeArc(obstacle, curvature, limit);
    // A step of 0.1 mm may leap over a place where the discs overlap by nanometres only.
    const Pose2 middle = alongArc({}, curvature, 0.5 * (free + stepped));
    const double overlap = kRadius + kClearance - distanceBetween(middle, obstacle);
    ASSERT_TRUE(std::abs(free - stepped) < 2.1e-4 || std::abs(overlap) < 1e-6)
        << "obstacle " << obstacle.x << ", " << obstacle.y << ", curvature " << curvature << ", limit " << limit << ": "
        << free << " and " << stepped;
    blocked += stepped < limit;
  }
  EXPECT_GT(blocked, 300);  // both outcomes are tried
  EXPECT_LT(blocked, 2700);
}

TEST(ShieldArc, TellsTheSmallestGapOfAnArc) {
  Shield shield(Footprint(kRadius), kHardMargin, kReach);
  EXPECT_DOUBLE_EQ(shield.arcGap({}, 1.0, 1.0), kReach);
  shield.show({{0.0, 2.4}});
  EXPECT_NEAR(shield.arcGap({}, 1.0, 0.0), 2.4 - kRadius, 1e-12);                      // at its start
  EXPECT_NEAR(shield.arcGap({}, 1.0, 3.2), 0.4 - kRadius, 1e-12);                      // passed on half a circle
  EXPECT_NEAR(shield.arcGap({}, 1.0, M_PI_2), std::hypot(1.0, 1.4) - kRadius, 1e-12);  // at its end
  shield.show({{1.0, 0.5}});
  EXPECT_NEAR(shield.arcGap({}, 0.0, 2.0), 0.5 - kRadius, 1e-12);
  EXPECT_NEAR(shield.arcGap({}, 0.0, 0.6), std::hypot(0.4, 0.5) - kRadius, 1e-12);
}

TEST(Shield, RefusesADiscThatItCannotWatch) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [](double radius, double margin, double reach) {
    return test::refusalOf<std::invalid_argument>([&] { Shield(Footprint(radius), margin, reach); });
  };
  const std::string expected = ", expected 0 < radius, 0 <= margin, radius + margin < reach";
  EXPECT_EQ(refusal(0.0, 0.03, 2.5), "the footprint's radius is 0, expected a positive number");
  EXPECT_EQ(refusal(nan, 0.03, 2.5), "the footprint's radius is nan, expected a positive number");
  EXPECT_EQ(refusal(0.2, -0.01, 2.5),
            "the footprint radius is 0.2, the hard margin -0.01 and the reach 2.5" + expected);
  EXPECT_EQ(refusal(0.2, 0.03, 0.23),
            "the footprint radius is 0.2, the hard margin 0.03 and the reach 0.23" + expected);
  EXPECT_EQ(refusal(0.2, 0.03, nan), "the footprint radius is 0.2, the hard margin 0.03 and the reach nan" + expected);
}

TEST(Shield, PassesOverWhatIsNoNumber) {
  Shield shield(Footprint(0.2), 0.03, 6.0);
  std::vector<Point2> wall(16, {2.0, 0.0});
  wall[3].x = std::numeric_limits<double>::quiet_NaN();
  shield.show(wall);
  EXPECT_NEAR(shield.freeDistance({}, 0.0, 6.0, 0.0), 1.8, 1e-9);
}

TEST(Shield, TakesOthersInBesideThoseOfTheScan) {
  Shield shield(Footprint(0.2), 0.03, 6.0);
  shield.show({{3.0, 0.0}});
  shield.add(std::vector<Point2>(40, {2.0, 0.0}));
  EXPECT_NEAR(shield.freeDistance({}, 0.0, 6.0, 0.0), 1.8, 1e-9);
  shield.show({{3.0, 0.0}});
  EXPECT_NEAR(shield.freeDistance({}, 0.0, 6.0, 0.0), 2.8, 1e-9);
}

}  // namespace
}  // namespace lstm_planner::test_shield
