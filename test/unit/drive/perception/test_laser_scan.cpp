#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_laser_scan {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The range that a reading becomes in the profile of a scan with these bounds, m.
float meaningOf(float reading, const ScanRules& rules, double range_min = 0.023, double range_max = 60.0) {
  LaserScan scan = makeHokuyoScan();
  scan.range_min = range_min;
  scan.range_max = range_max;
  scan.ranges.assign(1, reading);
  RangeProfile profile;
  toProfile(scan, {}, rules, &profile);
  return profile.ranges.front();
}

TEST(ToProfile, TakesNoFormOfNoReturnForAMeasuredRange) {
  const ScanRules ros;
  const ScanRules urg_node = urgNodeRules();
  for (const ScanRules& rules : {ros, urg_node}) {
    for (const float reading : {kInf, -kInf, kNan, 0.0f, -1.0f, 0.022f, 60.1f, 65.53f, 65.535f}) {
      const float meaning = meaningOf(reading, rules);
      EXPECT_FALSE(meaning > 0.0f && std::isfinite(meaning)) << reading;
    }
  }
  EXPECT_EQ(meaningOf(82.0f, ros, 0.023, 80.0), 0.0f) << "above range_max";
  EXPECT_EQ(meaningOf(65.53f, urg_node, 0.023, 80.0), kInf) << "a counter at its end, although below range_max";
  EXPECT_EQ(meaningOf(65.53f, ros, 0.023, 80.0), 65.53f) << "a range like any other, by REP-117";
  EXPECT_EQ(meaningOf(65.0f, urg_node, 0.023, 80.0), 65.0f);
  EXPECT_EQ(meaningOf(0.0f, ros, 0.0), 0.0f) << "0 is no return even where range_min allows it";
}

TEST(ToProfile, TakesOnlyInfinityForNothingThereByRep117) {
  const ScanRules rules;
  EXPECT_EQ(meaningOf(kInf, rules), kInf);
  EXPECT_EQ(meaningOf(2.0f, rules), 2.0f);
  EXPECT_EQ(meaningOf(-kInf, rules), -kInf) << "too near";
  for (const float reading : {kNan, 0.0f, -1.0f, 0.01f, 61.0f, 65.53f}) {
    EXPECT_EQ(meaningOf(reading, rules), 0.0f) << reading << " is not measured";
  }
}

TEST(ToProfile, TakesTheReadingsOfUrgNodeForNoReturn) {
  const ScanRules rules = urgNodeRules();
  for (const float reading : {kInf, 65.53f}) EXPECT_EQ(meaningOf(reading, rules), kInf) << reading;
  for (const float reading : {kNan, 0.0f, 61.0f}) {
    EXPECT_EQ(meaningOf(reading, rules), RangeProfile::kSilent) << reading << " shows no place to be free";
  }
  for (const float reading : {0.01f, -1.0f}) EXPECT_EQ(meaningOf(reading, rules), 0.0f) << reading;
}

TEST(ToProfile, CountsTheLimitsAsMeasured) {
  // 5.6f is below 5.6, 0.023f above 0.023 or the other way round: neither may matter.
  EXPECT_EQ(meaningOf(0.023f, {}, 0.023, 5.6), 0.023f);
  EXPECT_EQ(meaningOf(5.6f, {}, 0.023, 5.6), 5.6f);
}

TEST(ToProfile, TakesReadingsBelowRangeMinForNoReturnWhereTheDriverSendsThem) {
  ScanRules rules;
  rules.below_is_no_return = true;
  EXPECT_EQ(meaningOf(0.01f, rules), RangeProfile::kSilent);
  EXPECT_EQ(meaningOf(0.023f, rules), 0.023f);
  EXPECT_EQ(meaningOf(0.0f, rules), 0.0f);
  EXPECT_EQ(meaningOf(-1.0f, rules), 0.0f);
}

std::vector<Point2> pointsOf(const LaserScan& scan, const SensorMount& mount) {
  RangeProfile profile;
  BeamDirections directions;
  std::vector<Point2> points;
  toProfile(scan, mount, {}, &profile);
  addPoints(profile, &directions, &points);
  return points;
}

TEST(AddPoints, AppliesTheWholeMountAndLeavesOutNoReturns) {
  LaserScan scan = makeScan(-M_PI_2, M_PI_2, 3);
  scan.ranges = {1.0f, kNan, 3.0f};
  const std::vector<Point2> points = pointsOf(scan, {{0.1, 0.2, M_PI_2}, false});
  ASSERT_EQ(points.size(), 2u);
  // The beam to the sensor's right looks ahead when the sensor is turned left by 90 degrees.
  EXPECT_NEAR(points[0].x, 1.1, 1e-12);
  EXPECT_NEAR(points[0].y, 0.2, 1e-12);
  EXPECT_NEAR(points[1].x, -2.9, 1e-12);
  EXPECT_NEAR(points[1].y, 0.2, 1e-12);
}

TEST(AddPoints, PutsWhatIsTooNearToBeMeasuredAtTheNearestRange) {
  LaserScan scan = makeScan(0.0, 0.1, 2);
  scan.range_min = 0.12;
  scan.ranges = {-kInf, kNan};
  const std::vector<Point2> points = pointsOf(scan, {});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].x, 0.12, 1e-12);
}

TEST(AddPoints, MirrorsAScannerUpsideDown) {
  const LaserScan scan = makeScan(-M_PI_2, M_PI_2, 1, 1.0f);
  const std::vector<Point2> points = pointsOf(scan, {{}, true});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].y, 1.0, 1e-12);
}

}  // namespace
}  // namespace lstm_planner::test_laser_scan
