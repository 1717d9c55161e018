#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lstm_planner/drive/perception/deskew.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "unit/drive/perception/room_scans.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_deskew {
namespace {

constexpr double kStamp = 7.0;
constexpr double kWidth = 6.0;  // m, of a square room
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A robot that drives at `twist` and is in the middle of the room, a little turned, at the stamp.
struct Motion {
  Twist2 twist;
  Pose2 operator()(double time) const {
    const double elapsed = time - kStamp;
    const double yaw = 0.3 + twist.angular * elapsed;
    const double mean = 0.3 + 0.5 * twist.angular * elapsed;
    return {3.2 + twist.linear * elapsed * std::cos(mean), 2.7 + twist.linear * elapsed * std::sin(mean), yaw};
  }
};

/// Beside the middle of the robot, and turned.
HokuyoParameters turningScanner(const BeamTimes& times) {
  HokuyoParameters scanner = test::turningScanner(times);
  scanner.mount.pose = {0.1, -0.05, 0.4};
  return scanner;
}

ScanRules rulesWith(const BeamTimes& times) {
  ScanRules rules = Hokuyo::rules();
  rules.beam_times = times;
  return rules;
}

LaserScan sweptScan(const HokuyoParameters& scanner, const Motion& motion) {
  LaserScan scan;
  Hokuyo(scanner, 1).sweep(test::room(kWidth, kWidth), motion, kStamp, &scan);
  return scan;
}

/// m from the wall of the return that is farthest from it, seen from where the robot was at the stamp.
double worstErrorOf(const LaserScan& scan, const SensorMount& mount) {
  RangeProfile profile;
  toProfile(scan, mount, Hokuyo::rules(), &profile);
  std::vector<Point2> points;
  BeamDirections directions;
  addPoints(profile, &directions, &points);
  double worst = 0.0;
  for (const Point2& point : toParentFrame(Motion()(kStamp), points)) {
    const auto inside = [](double x) { return std::min(x, kWidth - x) - test::kWall; };
    worst = std::max(worst, std::abs(std::min(inside(point.x), inside(point.y))));
  }
  return worst;
}

const std::vector<BeamTimes> kDrivers = {{0.0, 0.2}, {0.2, 0.0}, {-0.2, 0.0}, {0.0, -0.2}, {0.1, -0.1}};

TEST(Deskew, PutsTheReturnsOfAMovingRobotBackOntoTheWalls) {
  // Half a beam of rounding, at most 4.3 m away: 0.038 m. A ninetieth of a turn is measured from one pose (Hokuyo):
  // 0.001 s of motion, 0.008 m.
  constexpr double kRounding = 0.05;
  for (const Twist2& twist : {Twist2{0.3, 1.5}, Twist2{0.0, -1.5}, Twist2{0.5, 0.2}}) {
    for (const BeamTimes& times : kDrivers) {
      const HokuyoParameters scanner = turningScanner(times);
      LaserScan scan = sweptScan(scanner, {twist});
      EXPECT_GT(worstErrorOf(scan, scanner.mount), 0.05) << "there is something to correct";
      deskew(scanner.mount, rulesWith(times), Motion{twist}, &scan);
      EXPECT_LT(worstErrorOf(scan, scanner.mount), kRounding)
          << times.first << ' ' << times.last << ' ' << twist.angular;
    }
  }
}

TEST(Deskew, WorksUpsideDownToo) {
  HokuyoParameters scanner = turningScanner({0.2, 0.0});
  scanner.mount.upside_down = true;
  LaserScan scan = sweptScan(scanner, {{0.3, 1.5}});
  deskew(scanner.mount, rulesWith(scanner.beam_times), Motion{{0.3, 1.5}}, &scan);
  EXPECT_LT(worstErrorOf(scan, scanner.mount), 0.05);
}

TEST(Deskew, WhereTheTurnSpreadsTheBeamsNoneIsMissing) {
  const HokuyoParameters scanner = turningScanner({0.0, 0.2});
  LaserScan scan = sweptScan(scanner, {{0.0, 1.5}});
  deskew(scanner.mount, rulesWith(scanner.beam_times), Motion{{0.0, 1.5}}, &scan);
  EXPECT_EQ(std::count(scan.ranges.begin(), scan.ranges.end(), kNotMeasured), 0);
}

TEST(Deskew, WhatTheScannerDidNotReachIsNotMeasured) {
  // In a turn of 0.3 rad against it, the scanner covers so much less of the room: 17 beams.
  const HokuyoParameters scanner = turningScanner({0.0, 0.2});
  LaserScan scan = sweptScan(scanner, {{0.0, -1.5}});
  deskew(scanner.mount, rulesWith(scanner.beam_times), Motion{{0.0, -1.5}}, &scan);
  EXPECT_NEAR(std::count(scan.ranges.begin(), scan.ranges.end(), kNotMeasured), 17, 1);
  RangeProfile profile;
  toProfile(scan, scanner.mount, Hokuyo::rules(), &profile);
  EXPECT_EQ(std::count(profile.ranges.begin(), profile.ranges.end(), 0.0f),
            std::count(scan.ranges.begin(), scan.ranges.end(), kNotMeasured))
      << "neither free nor silent";
}

TEST(Deskew, AnOpeningTurnsAsTheWallsDo) {
  LaserScan scan = makeScan(-M_PI, 2.0 * M_PI / 360.0, 360);
  scan.stamp = kStamp;
  std::fill(scan.ranges.begin() + 100, scan.ranges.begin() + 140, kInfinity);
  // Beam 120 is measured 0.1 s after the stamp, when the robot has turned by 0.1 rad: 6 beams.
  deskew({}, rulesWith({0.0, 0.3}), Motion{{0.0, 1.0}}, &scan);
  const auto is_open = [&](std::size_t beam) { return scan.ranges[beam] == kInfinity; };
  EXPECT_TRUE(is_open(107) && is_open(144));
  EXPECT_FALSE(is_open(102) || is_open(149));
}

TEST(Deskew, WhereTwoBeamsMeetTheNearerReturnCounts) {
  LaserScan scan = makeScan(-M_PI, 2.0 * M_PI / 360.0, 360, kInfinity);
  scan.stamp = kStamp;
  // The turn pushes the beams together: 0.3 rad of them are seen twice, first at the beginning, then at the end.
  scan.ranges[5] = 1.0f;
  scan.ranges[357] = 2.0f;
  scan.ranges[358] = 0.5f;
  LaserScan near_first = scan;
  deskew({}, rulesWith({0.0, 0.3}), Motion{{0.0, 1.0}}, &scan);
  // 357 and 358 are turned by 17 beams, across the end of the list: to beams 14 and 15.
  EXPECT_FLOAT_EQ(scan.ranges[14], 2.0f);
  EXPECT_FLOAT_EQ(scan.ranges[15], 0.5f);
  near_first.ranges[15] = 0.4f;  // turned by 0.7 of a beam, to beam 16
  near_first.ranges[14] = 0.6f;  // to beam 15
  deskew({}, rulesWith({0.0, 0.3}), Motion{{0.0, 1.0}}, &near_first);
  EXPECT_FLOAT_EQ(near_first.ranges[15], 0.5f) << "nearer than 0.6";
}

TEST(Deskew, ARobotThatStandsChangesNothing) {
  LaserScan scan = makeHokuyoScan();
  scan.ranges[3] = std::numeric_limits<float>::quiet_NaN();
  LaserScan same = scan;
  deskew({}, rulesWith({0.0, 0.2}), Motion{{0.01, 0.005}}, &same);
  EXPECT_TRUE(std::equal(scan.ranges.begin() + 4, scan.ranges.end(), same.ranges.begin() + 4));
  EXPECT_TRUE(std::isnan(same.ranges[3]));
}

TEST(Deskew, AScanThatIsNoneStaysAsItIs) {
  LaserScan scan = makeHokuyoScan();
  scan.angle_increment = std::numeric_limits<double>::quiet_NaN();
  deskew({}, rulesWith({0.0, 0.2}), Motion{{0.3, 1.5}}, &scan);
  EXPECT_EQ(scan.ranges, makeHokuyoScan().ranges);
  scan.ranges.clear();
  deskew({}, rulesWith({0.0, 0.2}), Motion{{0.3, 1.5}}, &scan);
  EXPECT_TRUE(scan.ranges.empty());
}

TEST(Deskew, WithoutTheTimesOfTheBeamsNothingChanges) {
  LaserScan scan = sweptScan(turningScanner({0.0, 0.2}), {{0.3, 1.5}});
  const LaserScan same = scan;
  deskew({}, Hokuyo::rules(), Motion{{0.3, 1.5}}, &scan);
  EXPECT_EQ(scan.ranges, same.ranges);
}

}  // namespace
}  // namespace lstm_planner::test_deskew
