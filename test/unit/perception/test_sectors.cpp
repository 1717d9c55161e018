#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "lstm_planner/perception/sectors.hpp"
#include "unit/perception/scan_builder.hpp"

namespace lstm_planner {
namespace {

constexpr double kCap = 6.0;
constexpr double kHalfDegree = M_PI / 360.0;

int total(const std::array<int, kSectorCount>& counts) { return std::accumulate(counts.begin(), counts.end(), 0); }

void expectEqualShares(const Sectors& sectors, int beams) {
  for (int sector = 0; sector < kSectorCount; ++sector) EXPECT_EQ(sectors.beams[sector], beams) << sector;
}

TEST(AverageSectors, UsesTheThesisSevenHundredTwentyBeamsOfTheHokuyo) {
  expectEqualShares(averageSectors(makeHokuyoScan(), {}, {}, kCap), 90);
}

TEST(AverageSectors, CountsTheSameBeamsWhateverTheRoundingOfTheAngles) {
  const LaserScan exact = makeScan(-0.75 * M_PI, M_PI / 720.0, 1081);
  expectEqualShares(averageSectors(exact, {}, {}, kCap), 90);
  const LaserScan as_floats = makeScan(static_cast<float>(-0.75 * M_PI), static_cast<float>(M_PI / 720.0), 1081);
  expectEqualShares(averageSectors(as_floats, {}, {}, kCap), 90);
}

TEST(AverageSectors, PutsABeamOnABorderToItsLeftWhateverTheRounding) {
  // Two thousandths of an increment: what six digits of angle_min and of the increment add up to.
  for (const double error : {-1e-5, 0.0, 1e-5}) {
    LaserScan scan = makeScan(-0.75 * M_PI + error, M_PI / 720.0, 1081, 5.0f);
    scan.ranges[180] = 1.0f;  // -90 degrees: the first beam of sector 0
    scan.ranges[540] = 2.0f;  // 0 degrees: the first beam of sector 4
    scan.ranges[900] = 1.0f;  // +90 degrees: outside of the half-open window
    const Sectors sectors = averageSectors(scan, {}, {}, kCap);
    EXPECT_NEAR(sectors.range[0], (89.0 * 5.0 + 1.0) / 90.0, 1e-9) << error;
    EXPECT_NEAR(sectors.range[3], 5.0, 1e-9) << error;
    EXPECT_NEAR(sectors.range[4], (89.0 * 5.0 + 2.0) / 90.0, 1e-9) << error;
    EXPECT_NEAR(sectors.range[7], 5.0, 1e-9) << error;
  }
}

TEST(AverageSectors, AcceptsNarrowerHokuyoConfigurations) {
  // The original set-up: 1041 beams within +-2.268 rad, no beam of which lies exactly on -90 degrees.
  const Sectors limited = averageSectors(makeScan(-2.268, 2.0 * 2.268 / 1040.0, 1041), {}, {}, kCap);
  for (int sector = 0; sector < kSectorCount; ++sector) EXPECT_NEAR(limited.beams[sector], 90, 1);
  expectEqualShares(averageSectors(makeScan(-M_PI_2, M_PI / 720.0, 721), {}, {}, kCap), 90);
  expectEqualShares(averageSectors(makeScan(-M_PI_2, kHalfDegree, 361), {}, {}, kCap), 45);
  expectEqualShares(averageSectors(makeScan(-M_PI_2, kHalfDegree, 360), {}, {}, kCap), 45);
}

TEST(AverageSectors, OrdersSectorsFromRightToLeft) {
  LaserScan scan = makeHokuyoScan(5.0f);
  for (std::size_t beam = 180; beam < 270; ++beam) scan.ranges[beam] = 1.0f;  // [-90, -67.5) degrees
  const Sectors sectors = averageSectors(scan, {}, {}, kCap);
  EXPECT_NEAR(sectors.range[0], 1.0, 1e-9);
  for (int sector = 1; sector < kSectorCount; ++sector) EXPECT_NEAR(sectors.range[sector], 5.0, 1e-9) << sector;
}

TEST(AverageSectors, TurnsWithTheMount) {
  // Turned left by 22.5 degrees: a beam of sector 0 of the sensor lies in sector 1 of the robot.
  LaserScan scan = makeHokuyoScan(5.0f);
  for (std::size_t beam = 180; beam < 270; ++beam) scan.ranges[beam] = 1.0f;
  const Sectors sectors = averageSectors(scan, {{0.0, 0.0, M_PI / 8.0}, false}, {}, kCap);
  expectEqualShares(sectors, 90);
  EXPECT_NEAR(sectors.range[1], 1.0, 1e-9);
  EXPECT_NEAR(sectors.range[0], 5.0, 1e-9);
}

TEST(AverageSectors, MirrorsAScannerUpsideDownAndANegativeIncrement) {
  LaserScan scan = makeScan(-0.75 * M_PI, M_PI / 720.0, 1081, 5.0f);
  for (std::size_t beam = 0; beam < 270; ++beam) scan.ranges[beam] = 1.0f;  // the right of the sensor
  const Sectors upside_down = averageSectors(scan, {{}, true}, {}, kCap);
  EXPECT_EQ(total(upside_down.beams), 720);
  EXPECT_NEAR(upside_down.range[0], 5.0, 1e-9);
  // Near are now the beams above 67.5 degrees, and sector 7 begins with the beam at 67.5 degrees: 89 of its 90.
  EXPECT_NEAR(upside_down.range[7], (89.0 * 1.0 + 5.0) / 90.0, 1e-9);

  LaserScan clockwise = makeScan(0.75 * M_PI, -M_PI / 720.0, 1081);
  clockwise.ranges = scan.ranges;
  EXPECT_EQ(averageSectors(clockwise, {}, {}, kCap).range, upside_down.range);
}

TEST(AverageSectors, UsesBothEndsOfAFullTurn) {
  for (const double angle_min : {-M_PI, 0.0, 1.0, -3.0 * M_PI}) {
    for (const std::size_t beams : {360u, 361u, 500u}) {
      const Sectors sectors = averageSectors(makeScan(angle_min, M_PI / 180.0, beams), {}, {}, kCap);
      EXPECT_EQ(total(sectors.beams), 180) << angle_min << " " << beams;
    }
  }
}

TEST(AverageSectors, AveragesEveryFormOfNoReturnAsTheCap) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float none : {inf, -inf, nan, 0.0f, -1.0f, 0.01f, 61.0f, 65.53f, 82.0f}) {
    LaserScan scan = makeHokuyoScan(2.0f);
    scan.ranges[300] = none;  // one of the 90 beams of sector 1
    const Sectors sectors = averageSectors(scan, {}, {}, kCap);
    EXPECT_NEAR(sectors.range[1], (89.0 * 2.0 + kCap) / 90.0, 1e-9) << none;
    EXPECT_EQ(sectors.measured[1], 89) << none;
  }
}

TEST(AverageSectors, SaysWhenASectorSawNothing) {
  LaserScan scan = makeHokuyoScan(10.0f);
  for (std::size_t beam = 180; beam < 270; ++beam) scan.ranges[beam] = 0.0f;
  const Sectors sectors = averageSectors(scan, {}, {}, kCap);
  EXPECT_FALSE(sectors.hasMeasurement(0));
  EXPECT_TRUE(sectors.hasMeasurement(1)) << "farther than the cap, but measured";
  EXPECT_EQ(sectors.range[0], kCap);
  EXPECT_EQ(sectors.range[1], kCap);
}

std::string refusal(const LaserScan& scan, const SensorMount& mount = {}) {
  try {
    averageSectors(scan, mount, {}, kCap);
  } catch (const UnusableScan& error) {
    return error.what();
  }
  return "";
}

TEST(AverageSectors, RefusesSpansThatLeaveAGap) {
  EXPECT_NE(refusal(makeScan(-1.5, 0.01, 301)).find("expected all of [-90, +90) degrees"), std::string::npos);
  EXPECT_EQ(refusal(makeHokuyoScan(), {{0.0, 0.0, M_PI_4}, false}), "") << "the margin of 45 degrees is used up";
  EXPECT_NE(refusal(makeHokuyoScan(), {{0.0, 0.0, M_PI_4 + 0.01}, false}), "");
  EXPECT_NE(refusal(makeScan(0.1, 0.01, 600)), "") << "a gap of 16 degrees ahead";
  // Half an increment may be missing at each edge, more may not.
  EXPECT_EQ(refusal(makeScan(-M_PI_2 + 0.49 * kHalfDegree, kHalfDegree, 360)), "");
  EXPECT_NE(refusal(makeScan(-M_PI_2 + 0.6 * kHalfDegree, kHalfDegree, 360)), "");
  EXPECT_NE(refusal(makeScan(-M_PI_2, kHalfDegree, 359)), "");
}

TEST(AverageSectors, RefusesUnusableGeometry) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(makeScan(-2.0, 0.01, 0)), "");
  EXPECT_NE(refusal(makeScan(nan, 0.01, 400)), "");
  EXPECT_NE(refusal(makeScan(-2.0, 0.0, 400)), "");
  EXPECT_NE(refusal(makeScan(-2.0, 1.0, 5)).find("at least one beam in each sector"), std::string::npos);
  EXPECT_NE(refusal(makeHokuyoScan(), {{nan, 0.0, 0.0}, false}), "");
  LaserScan scan = makeHokuyoScan();
  scan.range_max = 0.01;
  EXPECT_NE(refusal(scan), "");
  EXPECT_THROW(averageSectors(makeHokuyoScan(), {}, {}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner
