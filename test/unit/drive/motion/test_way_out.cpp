#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "drive/motion/way_out.hpp"
#include "unit/drive/motion/motion_fixtures.hpp"
#include "unit/drive/motion/plan_along.hpp"

namespace lstm_planner::test_way_out {
namespace {

using test::jackal;
using test::planAlong;

constexpr double kMargin = 0.03;  // m

/// A corridor along x that is too narrow for a Jackal to turn round in (its corners are 0.333 m from its middle), with
/// walls as far as `from` and `to` (m). Beyond them everything is free.
std::vector<Point2> corridor(double from, double to) {
  std::vector<Point2> returns;
  for (double x = from; x <= to; x += 0.01) {
    returns.push_back({x, 0.29});
    returns.push_back({x, -0.29});
  }
  return returns;
}

/// The poses on the straight line that the robot came along from there.
std::vector<Pose2> cameFrom(double x) {
  std::vector<Pose2> poses;
  for (; x < 0.0; x += 0.02) poses.push_back({x, 0.0, 0.0});
  return poses;
}

class WayOut : public ::testing::Test {
 protected:
  void see(const std::vector<Point2>& returns) {
    returns_ = returns;
    shield_.show(returns);
  }

  double gap(const Pose2& pose) const {
    double gap = 10.0;
    for (const Point2& place : returns_) gap = std::min(gap, jackal().distanceTo(toLocalFrame(pose, place)));
    return gap;
  }

  /// That the footprint fits all along, and that from one pose to the next it is as far as the header says. A sweep is
  /// exact to a millimetre, and the search lets a piece lack another one.
  void expectDrivable(const std::vector<Pose2>& way) const {
    ASSERT_FALSE(way.empty());
    EXPECT_EQ(distanceBetween(way.front(), Pose2{}), 0.0);
    for (std::size_t i = 0; i < way.size(); ++i) {
      EXPECT_GE(gap(way[i]), kMargin - 2e-3) << i;
      if (i == 0) continue;
      EXPECT_LE(distanceBetween(way[i - 1], way[i]), 0.02 + 1e-9);
      EXPECT_LE(std::abs(normalizeAngle(way[i].yaw - way[i - 1].yaw)), 0.05 + 1e-9);
    }
  }

  Shield shield_{jackal(), kMargin, 4.0};

 private:
  std::vector<Point2> returns_;
};

TEST_F(WayOut, DrivesOnToWhereItCanTurn) {
  see(corridor(-3.0, 0.4));
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {-3.0, 0.0}});
  ASSERT_LT(shield_.freeTurn({}, M_PI, kMargin), 1.0);
  const std::vector<Pose2> way = findWayOut(shield_, kMargin, {}, plan);
  expectDrivable(way);
  EXPECT_GT(way.back().x, 0.4) << "beyond the walls";
  EXPECT_NEAR(std::abs(normalizeAngle(way.back().yaw)), M_PI, 0.3) << "along the plan";
}

TEST_F(WayOut, LeadsBackWhereTheRobotWasAndNowhereElse) {
  std::vector<Point2> returns = corridor(-0.8, 3.0);
  returns.push_back({0.33, 0.0});  // and not on
  see(returns);
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {-3.0, 0.0}});
  EXPECT_TRUE(findWayOut(shield_, kMargin, {}, plan).empty()) << "what is behind it, it does not know";
  const std::vector<Pose2> way = findWayOut(shield_, kMargin, cameFrom(-1.5), plan);
  expectDrivable(way);
  EXPECT_LT(way.back().x, -0.8);
  EXPECT_NEAR(std::abs(normalizeAngle(way.back().yaw)), M_PI, 0.3);
  for (const Pose2& pose : way) {
    if (std::abs(pose.yaw) < 0.1) {
      EXPECT_NEAR(pose.y, 0.0, 0.05) << "where it came";
    }
  }
}

TEST_F(WayOut, TakesTheShorterOne) {
  // It can turn 0.5 m ahead and, where it came from, 1.2 m behind; and the other way round.
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {-3.0, 0.0}});
  const auto end = [&](double from, double to) {
    see(corridor(from, to));
    const std::vector<Pose2> way = findWayOut(shield_, kMargin, cameFrom(-1.8), plan);
    expectDrivable(way);
    return way.back().x;
  };
  EXPECT_GT(end(-1.2, 0.2), 0.0);
  EXPECT_LT(end(-0.2, 1.2), 0.0);
}

TEST_F(WayOut, IsNoneWhereNothingLeadsOut) {
  std::vector<Point2> returns = corridor(-0.6, 0.6);
  for (double y = -0.3; y < 0.3; y += 0.01) {
    returns.push_back({0.6, y});
    returns.push_back({-0.6, y});
  }
  see(returns);
  EXPECT_TRUE(findWayOut(shield_, kMargin, cameFrom(-0.3), planAlong({{0.0, 0.0}, {-3.0, 0.0}})).empty());
}

TEST_F(WayOut, IsNoneWithoutAPlan) {
  see({});
  EXPECT_TRUE(findWayOut(shield_, kMargin, {}, {}).empty());
}

TEST_F(WayOut, OnlyTurnsWhereThatIsEnough) {
  see({});
  const std::vector<Pose2> way = findWayOut(shield_, kMargin, {}, planAlong({{0.0, 0.0}, {0.0, 3.0}}));
  ASSERT_FALSE(way.empty());
  EXPECT_NEAR(way.back().yaw, M_PI_2, 0.01);
  for (const Pose2& pose : way) {
    EXPECT_EQ(std::hypot(pose.x, pose.y), 0.0);
  }
}

}  // namespace
}  // namespace lstm_planner::test_way_out
