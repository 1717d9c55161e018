#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/drive/perception/moving_returns.hpp"
#include "lstm_planner/drive/perception/moving_things.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "support/refusal.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_moving_returns {
namespace {

constexpr double kPeriod = 0.1;

/// Walls and persons (discs), seen by a Hokuyo with its noise and drop-outs.
class MovingReturnsTest : public ::testing::Test {
 protected:
  MovingReturnsTest() : moving_(MovingReturnsParameters{}), hokuyo_(HokuyoParameters{}, 1) {}

  /// Shows the scan from `pose` in a hall whose walls are drawn into grid_, with persons; `odometry` is what the robot
  /// believes of its pose.
  void sense(const Pose2& pose, const std::vector<Circle>& persons, const Pose2& odometry) {
    const GridWorld walls(grid_);
    const CircleWorld world(persons, &walls);
    hokuyo_.scan(world, pose, time_, &scan_);
    toProfile(scan_, {}, {}, &profile_);
    moving_.show(profile_, odometry, time_);
    time_ += kPeriod;
  }
  void sense(const Pose2& pose, const std::vector<Circle>& persons = {}) { sense(pose, persons, pose); }

  /// Moving points within `distance` of a place in the world (odometry is the truth).
  int movingNear(const Point2& place, double distance, const Pose2& pose) const {
    int count = 0;
    for (const Point2& point : moving_.points()) {
      count += distanceBetween(toParentFrame(pose, point), place) < distance;
    }
    return count;
  }

  OccupancyGrid grid_ = test::emptyHall(10.0, 10.0);
  MovingReturns moving_;
  Hokuyo hokuyo_;
  LaserScan scan_;
  RangeProfile profile_;
  double time_ = 0.0;
};

TEST_F(MovingReturnsTest, AWallThatComesIntoTheScannersSightDoesNotMove) {
  HokuyoParameters short_sighted;
  short_sighted.range_max = short_sighted.sight = 3.5;
  hokuyo_ = Hokuyo(short_sighted, 1);
  for (int i = 0; i < 30; ++i) {
    const Pose2 pose{5.0, 5.0 + 0.05 * i, M_PI_2};
    sense(pose);
    EXPECT_TRUE(moving_.points().empty()) << pose.y;
  }
}

TEST_F(MovingReturnsTest, ARobotAtFullSpeedFindsPeopleAsOneThatStandsDoes) {
  // At 2.1 m/s in noisy odometry: what is twice the robot's speed has jumped, and no less.
  for (const double fastest : {0.3, 2.0}) {
    moving_.reset();
    moving_.expectSpeed(fastest);
    Pose2 pose{5.0, 1.0, M_PI_2};
    Circle person{{4.0, 6.0}, 0.25};
    for (int i = 0; i < 10; ++i) {
      sense(pose, {person});
      pose.y += 2.1 * kPeriod;
      person.center.x += 1.0 * kPeriod;
    }
    EXPECT_EQ(moving_.points().empty(), fastest < 1.0) << fastest;
  }
}

TEST_F(MovingReturnsTest, FindsAPersonWhoCrosses) {
  const Pose2 pose{5.0, 2.0, M_PI_2};
  for (int i = 0; i < 10; ++i) {
    const Circle person{{3.5 + 0.1 * i, 4.0}, 0.25};  // 1 m/s to the right
    sense(pose, {person});
    if (i >= 4) {
      EXPECT_GT(movingNear(person.center, 0.35, pose), 5) << "scan " << i;
      EXPECT_EQ(movingNear(person.center, 0.5, pose), static_cast<int>(moving_.points().size())) << "scan " << i;
    }
  }
}

TEST_F(MovingReturnsTest, FindsAPersonWhoComesNearerAtAnySpeed) {
  const Pose2 pose{5.0, 2.0, M_PI_2};
  for (const double speed : {0.25, 0.5, 1.0}) {
    moving_.reset();
    double first_seen = -1.0;
    for (int i = 0; i < 12; ++i) {
      const Circle person{{5.0, 5.0 - speed * kPeriod * i}, 0.25};
      sense(pose, {person});
      if (first_seen < 0.0 && movingNear(person.center, 0.35, pose) > 5) first_seen = kPeriod * i;
    }
    EXPECT_GT(first_seen, 0.0) << speed;
    EXPECT_LE(first_seen, speed < 0.5 ? 0.6 : 0.4) << speed;  // the margin and three deviations of noise
  }
}

/// A scanner that sees all around, as an LDS-01. Its first beam may look ahead or back.
TEST_F(MovingReturnsTest, WhatComesTowardsTheFirstBeamIsFoundAsAnywhereElse) {
  HokuyoParameters all_around;
  all_around.beams = 360;
  all_around.angle_min = -M_PI;
  all_around.angle_increment = 2.0 * M_PI / all_around.beams;
  hokuyo_ = Hokuyo(all_around, 1);
  MovingReturns ahead{MovingReturnsParameters{}};
  MovingThings things;
  MovingThings things_ahead;
  const Pose2 pose{5.0, 2.0, M_PI_2};
  std::size_t found = 0;
  for (int i = 0; i < 25; ++i) {
    sense(pose, {{{5.0, 5.0 - 0.1 * i}, 0.06}});  // a leg, at 1 m/s
    found += moving_.points().empty() ? 0 : 1;
    RangeProfile turned = profile_;
    std::rotate(turned.ranges.begin(), turned.ranges.begin() + all_around.beams / 2, turned.ranges.end());
    turned.first_direction = 0.0;
    ahead.show(turned, pose, time_ - kPeriod);
    ASSERT_EQ(ahead.points().size(), moving_.points().size()) << "scan " << i;
    things.show(moving_.returns(), moving_.moves(), time_);
    things_ahead.show(ahead.returns(), ahead.moves(), time_);
    ASSERT_EQ(things_ahead.around(pose).size(), things.around(pose).size()) << "scan " << i;
  }
  EXPECT_GT(found, 8U);
}

TEST_F(MovingReturnsTest, FindsAPersonWhoStepsOutFromBehindAnotherOne) {
  // In 0.2 s, the age of the newest scan for the comparison, 0.12 m: the margin and three deviations of noise.
  const double speed = 0.6;
  const Pose2 pose{5.0, 2.0, M_PI_2};
  Circle hidden{{5.0, 3.2}, 0.2};
  for (int i = 0; i < 10; ++i) sense(pose, {{{5.0, 2.7}, 0.25}, hidden});
  for (int i = 0; i <= 2; ++i, hidden.center.y -= speed * kPeriod) sense(pose, {hidden});
  EXPECT_GT(movingNear(hidden.center, 0.35, pose), 5);
}

TEST_F(MovingReturnsTest, LeavesThePersonAloneWhoGoesAway) {
  const Pose2 pose{5.0, 2.0, M_PI_2};
  for (int i = 0; i < 15; ++i) {
    sense(pose, {{{5.0, 3.5 + 0.1 * i}, 0.25}});
    EXPECT_TRUE(moving_.points().empty()) << "scan " << i;
  }
}

TEST_F(MovingReturnsTest, CountsAPersonWhoStandsStillAsRestingAndThenAsStatic) {
  const Pose2 pose{5.0, 3.0, M_PI_2};
  Circle person{{5.0, 5.0}, 0.25};
  for (int i = 0; i < 10; ++i, person.center.y -= 0.1) sense(pose, {person});
  const double stops = time_;
  while (time_ < stops + 0.9) {
    sense(pose, {person});
    EXPECT_GT(movingNear(person.center, 0.35, pose), 5);
  }
  // Where it stands was seen free up to 0.6 s after it came, and is held for 1 s after that.
  while (time_ < stops + 1.8) sense(pose, {person});
  EXPECT_TRUE(moving_.points().empty());
  EXPECT_GT(moving_.resting().size(), 5u);
  while (time_ < stops + 0.6 + MovingReturnsParameters{}.remember + kPeriod) sense(pose, {person});
  EXPECT_TRUE(moving_.resting().empty());
}

TEST_F(MovingReturnsTest, RemembersForAWhileWhomItHasTurnedItsBackTo) {
  const Pose2 pose{5.0, 5.0, 0.0};
  Circle person{{7.5, 5.0}, 0.25};
  for (int i = 0; i < 10; ++i, person.center.x -= 0.1) sense(pose, {person});
  const Pose2 turned{5.0, 5.0, M_PI};  // the scanner sees 135 degrees to either side
  for (int i = 0; i < 8; ++i) {
    sense(turned, {person});
    EXPECT_GT(movingNear(person.center, 0.35, turned), 0) << "scan " << i;
  }
  for (int i = 0; i < 10; ++i) sense(turned, {person});
  EXPECT_TRUE(moving_.points().empty());
}

TEST_F(MovingReturnsTest, FlagsNothingStaticOnAPathThroughRooms) {
  // Round corners and past posts, turning fast, with 2 % of odometry error, noise and lost beams: all that is newly
  // seen was hidden before.
  test::fillBox(0.0, 4.0, 4.0, 4.2, &grid_);
  test::fillBox(5.2, 4.0, 10.0, 4.2, &grid_);
  test::fillBox(2.0, 6.0, 2.2, 10.0, &grid_);
  test::fillBox(6.0, 6.5, 6.1, 6.6, &grid_);
  test::fillBox(7.0, 2.0, 7.1, 2.1, &grid_);
  Random random(3);
  Pose2 pose{1.0, 1.0, 0.0};
  Pose2 odometry = pose;
  int scans = 0;
  const std::vector<Point2> corners = {{4.6, 1.5}, {4.6, 5.0}, {1.0, 5.2}, {1.2, 9.0}, {1.2, 5.2}, {9.0, 8.0}};
  for (const Point2& corner : corners) {
    while (distanceBetween(pose, corner) > 0.1) {
      const double error = normalizeAngle(directionTo(pose, corner) - pose.yaw);
      const double turn = std::max(-0.2, std::min(0.2, error));  // 2 rad/s
      const double path = std::abs(error) < 0.3 ? 0.03 : 0.0;
      pose = {pose.x + path * std::cos(pose.yaw), pose.y + path * std::sin(pose.yaw), pose.yaw + turn};
      odometry = {odometry.x + 1.02 * path * std::cos(odometry.yaw), odometry.y + 1.02 * path * std::sin(odometry.yaw),
                  odometry.yaw + 1.02 * turn};
      sense(pose, {}, odometry);
      ASSERT_TRUE(moving_.points().empty()) << "scan " << scans << " at " << pose.x << ", " << pose.y;
      ++scans;
    }
  }
  EXPECT_GT(scans, 500);
}

TEST_F(MovingReturnsTest, StartsAnewWhenOdometryOrClockJump) {
  test::fillBox(6.0, 6.5, 6.4, 6.9, &grid_);
  const Pose2 pose{5.0, 5.0, 0.5};
  for (int i = 0; i < 8; ++i) sense(pose);
  for (int i = 0; i < 8; ++i) sense(pose, {}, {9.0, 5.0, 0.5});
  EXPECT_TRUE(moving_.points().empty());
  time_ = 0.0;
  for (int i = 0; i < 8; ++i) sense(pose, {}, {9.0, 5.0, 0.5});
  EXPECT_TRUE(moving_.points().empty());
  sense(pose, {}, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  EXPECT_TRUE(moving_.points().empty());
}

TEST_F(MovingReturnsTest, TakesAnEmptyScan) {
  for (int i = 0; i < 8; ++i) {
    moving_.show({}, {}, 0.1 * i);
    EXPECT_TRUE(moving_.points().empty());
  }
}

TEST_F(MovingReturnsTest, RefusesTimesAndMarginsThatMakeNoSense) {
  MovingReturnsParameters parameters;
  const auto refusal = [&] { return test::refusalOf<std::invalid_argument>([&] { MovingReturns{parameters}; }); };
  parameters.oldest = 0.1;
  EXPECT_EQ(refusal(), "parameter moving/oldest is 0.1, expected more than youngest");
  parameters = {};
  parameters.range_margin = 0.0;
  EXPECT_EQ(refusal(), "parameter moving/range_margin is 0, expected a number in [0.001, 10]");
  parameters = {};
  parameters.hold = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(), "parameter moving/hold is nan, expected a number in [0, 600]");
}

}  // namespace
}  // namespace lstm_planner::test_moving_returns
