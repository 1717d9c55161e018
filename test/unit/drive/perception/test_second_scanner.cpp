// What a second scanner adds to a situation, and when its scans are refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/perception/moving_surroundings.hpp"
#include "lstm_planner/drive/perception/out_of_view.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "support/refusal.hpp"
#include "unit/drive/motion/motion_fixtures.hpp"
#include "unit/drive/motion/plan_along.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_second_scanner {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const SensorMount kAtTheBack{{-0.2, 0.0, M_PI}, false};

/// Half a turn around its middle, a degree apart.
LaserScan halfScan(float range = kInf) { return makeScan(-M_PI_2, M_PI / 180.0, 181, range); }

/// A robot whose first scanner sees the half in front, its second one the half behind.
class TwoScanners : public ::testing::Test {
 protected:
  TwoScanners() {
    parameters_.noise = 0.0;
    parameters_.dropout = 0.0;
    parameters_.beams = 181;
    parameters_.angle_min = -M_PI_2;
    parameters_.angle_increment = M_PI / 180.0;
  }

  LaserScan scanFrom(const Pose2& pose, const SensorMount& mount) {
    parameters_.mount = mount;
    LaserScan scan;
    Hokuyo(parameters_, 1).scan(world_, pose, 0.0, &scan);
    return scan;
  }

  /// The second scan was taken at another place.
  const Situation& see(const Pose2& pose, const Pose2& second_pose, double time = 0.0) {
    perceive(scanFrom(pose, {}), {}, {}, 6.0, &situation_);
    situation_.pose = pose;
    situation_.time = time;
    const LaserScan scan = scanFrom(second_pose, kAtTheBack);
    perceiveSecond({scan, kAtTheBack, second_pose, time}, {}, &situation_);
    return situation_;
  }
  const Situation& see(const Pose2& pose, double time = 0.0) { return see(pose, pose, time); }

  static constexpr Circle kPost{{-1.0, 0.0}, 0.1};  ///< behind a robot at the origin
  CircleWorld world_{{kPost}};
  HokuyoParameters parameters_;
  Situation situation_;
};

TEST_F(TwoScanners, ReturnsOfTheSecondOneAreObstaclesAndNoSectorChanges) {
  const Situation& situation = see({});
  ASSERT_GT(situation.obstacles.size(), 5u);
  for (const Point2& point : situation.obstacles) EXPECT_NEAR(distanceBetween(point, kPost.center), 0.1, 1e-3);
  for (const double range : situation.sectors.range) EXPECT_DOUBLE_EQ(range, 6.0);
}

TEST_F(TwoScanners, WhatTheSecondOneSawFromAnotherPlaceLiesWhereItIs) {
  const Pose2 pose{0.3, 0.2, 0.4};
  const Situation& situation = see(pose, {0.1, 0.1, 0.1});
  ASSERT_GT(situation.obstacles.size(), 5u);
  for (const Point2& point : situation.obstacles) {
    EXPECT_NEAR(distanceBetween(toParentFrame(pose, point), kPost.center), 0.1, 1e-3);
  }
}

TEST_F(TwoScanners, WhatTheSecondOneSawIsForgottenWithTheNextScanOfTheFirst) {
  see({});
  perceive(halfScan(), {}, {}, 6.0, &situation_);
  EXPECT_TRUE(situation_.obstacles.empty());
  EXPECT_EQ(situation_.second.profile.beamTowards(M_PI), -1) << "nor does it show anything free";
}

TEST_F(TwoScanners, TheMemoryHoldsWhatOnlyTheSecondOneSeesUntilItSeesThatItHasGone) {
  LocalMap memory({}, {});
  const Pose2 pose{5.0, 5.0, 0.0};
  world_ = CircleWorld({{{4.0, 5.0}, 0.1}});
  memory.add(see(pose));
  ASSERT_FALSE(memory.obstacles().empty());
  for (const Point2& place : memory.obstacles()) EXPECT_NEAR(distanceBetween(place, Point2{4.0, 5.0}), 0.1, 0.1);
  world_ = CircleWorld({});
  perceive(scanFrom(pose, {}), {}, {}, 6.0, &situation_);
  memory.add(situation_);
  EXPECT_FALSE(memory.obstacles().empty()) << "the first scanner does not see the place";
  memory.add(see(pose));
  EXPECT_TRUE(memory.obstacles().empty());
}

TEST_F(TwoScanners, NothingIsOutOfViewThatTheSecondOneSees) {
  OutOfView out_of_view(test::jackal());
  world_ = CircleWorld({{{0.5, 0.0}, 0.1}});
  see({});
  out_of_view.show(situation_);
  see({0.0, 0.0, M_PI});
  out_of_view.show(situation_);
  EXPECT_TRUE(out_of_view.points().empty());
}

TEST_F(TwoScanners, SomebodyWhoComesFromBehindIsSeenToMove) {
  MovingSurroundings surroundings{MovingReturnsParameters()};
  MovingSurroundings surroundings_later = surroundings;
  std::vector<MovingThing> things, things_later;
  for (int i = 0; i < 12; ++i) {
    world_ = CircleWorld({{{-3.0 + 0.1 * i, 0.0}, 0.25}});
    surroundings.show(see({}, 0.1 * i));
    things = surroundings.follow(situation_, situation_.pose, 0.0);
    surroundings_later.show(situation_);
    things_later = surroundings_later.follow(situation_, {0.5, 0.0, 0.0}, 0.3);
  }
  ASSERT_FALSE(surroundings.points().empty());
  for (const Point2& point : surroundings.points()) EXPECT_LT(point.x, -1.0);
  ASSERT_EQ(things.size(), 1u);
  EXPECT_NEAR(things.front().velocity.x, 1.0, 0.15);
  EXPECT_NEAR(things.front().velocity.y, 0.0, 0.15);
  ASSERT_EQ(things_later.size(), 1u);
  EXPECT_NEAR(things_later.front().center.x, things.front().center.x + 0.3 * things.front().velocity.x - 0.5, 1e-9);
  surroundings.reset();
  EXPECT_TRUE(surroundings.points().empty());
}

/// A robot with corners that stands between walls, with something in front of it: it can only go back.
class TwoScannersInACorridor : public TwoScanners {
 protected:
  MotionCommand compute(bool has_second) {
    Shield shield(test::jackal(), 0.03, 4.0);
    see({});
    std::vector<Point2> seen = situation_.obstacles;
    if (!has_second) {
      const auto isBehind = [](const Point2& point) { return point.x < -0.2; };
      seen.erase(std::remove_if(seen.begin(), seen.end(), isBehind), seen.end());
    }
    shield.show(seen);
    const std::vector<Pose2> plan = test::planAlong({{0.0, 0.0}, {-3.0, 0.1}});
    return MotionController(test::limitsOfJackal())
        .compute({plan, {}, {}, shield, 0.1}, {}, {}, {Pose2{-0.06, 0.0, 0.0}, false});
  }

  void build(const std::vector<Circle>& more) {
    std::vector<Circle> posts = more;
    for (double x = -0.3; x <= 0.31; x += 0.1) {
      posts.push_back({{x, 0.27}, 0.01});
      posts.push_back({{x, -0.27}, 0.01});
    }
    world_ = CircleWorld(posts);
  }
};

TEST_F(TwoScannersInACorridor, WhatOnlyTheSecondOneSeesStopsAMotionBackward) {
  const Circle ahead{{0.32, 0.0}, 0.02};
  build({ahead});
  EXPECT_LT(compute(true).linear, -0.05) << "nothing is behind";
  build({ahead, {{-0.275, 0.0}, 0.02}});  // a millimetre behind it
  EXPECT_LT(compute(false).linear, -0.05) << "it would back into what it does not see";
  EXPECT_GT(compute(true).linear, -0.01) << "it may creep by a millimetre";
}

TEST_F(TwoScanners, WhatOnlyTheSecondOneSeesStopsATurn) {
  Shield shield(test::jackal(), 0.03, 4.0);
  world_ = CircleWorld({{{-0.32, 0.1}, 0.02}});  // a corner reaches 0.333 m
  shield.show(see({}).obstacles);
  EXPECT_LT(shield.freeTurn({}, M_PI_2, 0.03), 0.5);
}

TEST_F(TwoScanners, TheSecondOneMayLookAnywhereAndTheFirstOneMayNot) {
  perceive(halfScan(), {}, {}, 6.0, &situation_);
  const LaserScan narrow = makeScan(-0.5, 0.01, 101);
  EXPECT_NO_THROW(perceiveSecond({narrow, kAtTheBack, {}, 0.0}, {}, &situation_));
  EXPECT_THROW(perceive(narrow, kAtTheBack, {}, 6.0, &situation_), UnusableScan);
}

std::string refusalOf(const LaserScan& scan, const SensorMount& mount = kAtTheBack) {
  Situation situation;
  perceive(halfScan(), {}, {}, 6.0, &situation);
  return test::refusalOf<UnusableScan>([&] { perceiveSecond({scan, mount, {}, 0.0}, {}, &situation); });
}

TEST(SecondScannerRefused, IsNamedWithTheReason) {
  LaserScan half_covered = halfScan();
  std::fill(half_covered.ranges.begin(), half_covered.ranges.begin() + 23, kNan);  // one of its eight sections
  EXPECT_EQ(refusalOf(half_covered).rfind("the second scanner: the scan has 0 of 22 beams measured from ", 0), 0u)
      << refusalOf(half_covered);
  EXPECT_EQ(refusalOf(LaserScan()).rfind("the second scanner: the scan has no ranges", 0), 0u);
  EXPECT_EQ(refusalOf(halfScan(), {{200.0, 0.0, 0.0}, false}).rfind("the second scanner: the scanner is at (200", 0),
            0u);
  EXPECT_EQ(refusalOf(halfScan(kNan)), refusalOf(half_covered));
}

TEST(SecondScannerRefused, ReadingsMeanTheSameAsOfTheFirst) {
  ScanRules rules;
  rules.nan_is_no_return = true;
  Situation situation;
  perceive(halfScan(), {}, {}, 6.0, &situation);
  const LaserScan silent = halfScan(kNan);
  EXPECT_NO_THROW(perceiveSecond({silent, kAtTheBack, {}, 0.0}, rules, &situation));
}

}  // namespace
}  // namespace lstm_planner::test_second_scanner
