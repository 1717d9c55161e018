#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "lstm_planner/drive/perception/sectors.hpp"
#include "support/refusal.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_sectors {
namespace {

using testing::HasSubstr;

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
  // Near are now the beams above 67.5 degrees, and sector 7 starts with the beam at 67.5 degrees: 89 of its 90.
  EXPECT_NEAR(upside_down.range[7], (89.0 * 1.0 + 5.0) / 90.0, 1e-9);

  LaserScan clockwise = makeScan(0.75 * M_PI, -M_PI / 720.0, 1081);
  clockwise.ranges = scan.ranges;
  EXPECT_EQ(averageSectors(clockwise, {}, {}, kCap).range, upside_down.range);
}

TEST(AverageSectors, UsesBothEndsOfAFullTurn) {
  for (const double angle_min : {-M_PI, 0.0, 1.0, -3.0 * M_PI, -M_PI_2 + 0.03}) {
    for (const std::size_t beams : {360u, 361u, 500u}) {
      const Sectors sectors = averageSectors(makeScan(angle_min, M_PI / 180.0, beams), {}, {}, kCap);
      EXPECT_EQ(total(sectors.beams), 180) << angle_min << " " << beams;
    }
  }
}

TEST(AverageSectors, TakesAScannerOf180DegreesThatIsMountedALittleTurned) {
  for (const double yaw : {0.03, -0.03}) {
    LaserScan scan = makeScan(-M_PI_2, kHalfDegree, 361, 2.0f);
    const std::size_t last = scan.ranges.size() - 1;
    scan.ranges[yaw > 0.0 ? 0 : last] = 5.0f;  // beside what is missing
    const Sectors sectors = averageSectors(scan, {{0.0, 0.0, yaw}, false}, {}, kCap);
    const int sector = yaw > 0.0 ? 0 : kSectorCount - 1;
    EXPECT_EQ(sectors.beams[sector], 42) << "3.4 of 45 are missing";
    EXPECT_NEAR(sectors.range[sector], (41.0 * 2.0 + 5.0) / 42.0, 1e-9) << "the mean of those that there are";
    EXPECT_EQ(sectors.beams[kSectorCount - 1 - sector], 45);
  }
}

/// As drivers send it that divide the span of the readings that they got by their number: the TurtleBot3's LDS-02.
TEST(AverageSectors, TakesAFullTurnOfWhichOneBeamIsMissingAhead) {
  for (const double yaw : {0.0, M_PI, 2.0, -M_PI_2}) {
    const LaserScan scan = makeScan(0.012, kFullTurn / 251.1, 250);
    const Sectors sectors = averageSectors(scan, {{0.0, 0.0, yaw}, false}, {}, kCap);
    EXPECT_NEAR(total(sectors.beams), 125, 1) << yaw;
  }
  RangeProfile profile;
  toProfile(makeScan(0.012, kFullTurn / 251.1, 250), {}, {}, &profile);
  EXPECT_EQ(profile.beamTowards(0.010), 0);
  EXPECT_EQ(profile.beamTowards(-0.020), 249);
  for (double direction = -0.1; direction < 0.1; direction += 0.001) EXPECT_GE(profile.beamTowards(direction), 0);
}

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Of a scan of 2 m with another reading in one of the 90 beams of sector 1.
double averageWith(float reading, const ScanRules& rules) {
  LaserScan scan = makeHokuyoScan(2.0f);
  scan.ranges[300] = reading;
  const Sectors sectors = averageSectors(scan, {}, rules, kCap);
  EXPECT_EQ(sectors.measured[1], 89) << reading;
  return sectors.range[1];
}

TEST(AverageSectors, AveragesEveryFormOfNoReturnAsTheCap) {
  for (const float none : {kInf, kNan, 0.0f, 61.0f, 65.53f, 82.0f}) {
    EXPECT_NEAR(averageWith(none, urgNodeRules()), (89.0 * 2.0 + kCap) / 90.0, 1e-9) << none;
  }
  EXPECT_NEAR(averageWith(kInf, ScanRules()), (89.0 * 2.0 + kCap) / 90.0, 1e-9);
}

TEST(AverageSectors, LeavesOutWhatWasNotMeasured) {
  for (const float unmeasured : {-kInf, kNan, 0.0f, -1.0f, 0.01f, 61.0f, 65.53f}) {
    EXPECT_DOUBLE_EQ(averageWith(unmeasured, ScanRules()), 2.0) << unmeasured;
  }
}

TEST(AverageSectors, SaysWhenASectorSawNothing) {
  LaserScan scan = makeHokuyoScan(10.0f);
  for (std::size_t beam = 180; beam < 270; ++beam) scan.ranges[beam] = kInf;
  const Sectors sectors = averageSectors(scan, {}, {}, kCap);
  EXPECT_FALSE(sectors.hasMeasurement(0));
  EXPECT_TRUE(sectors.hasMeasurement(1)) << "farther than the cap, but measured";
  EXPECT_EQ(sectors.range[0], kCap);
  EXPECT_EQ(sectors.range[1], kCap);
}

std::string refusal(const LaserScan& scan, const SensorMount& mount = {}, const ScanRules& rules = {}) {
  return test::refusalOf<UnusableScan>([&] { averageSectors(scan, mount, rules, kCap); });
}

TEST(AverageSectors, RefusesSpansThatLeaveAGap) {
  const auto covers = [](const std::string& span) {
    return "the scan covers " + span + " degrees around the robot's heading, expected at least -87 to +87 degrees";
  };
  EXPECT_EQ(refusal(makeScan(-1.5, 0.01, 301)), covers("-85.9437 degrees to 85.9437"));
  const double degree = M_PI / 180.0;
  EXPECT_EQ(refusal(makeScan(-80.0 * degree, degree, 161)), covers("-80 degrees to 80"));
  EXPECT_EQ(refusal(makeHokuyoScan(), {{0.0, 0.0, M_PI_4 + 0.05}, false}), "") << "45 degrees more, and 3";
  EXPECT_EQ(refusal(makeHokuyoScan(), {{0.0, 0.0, M_PI_4 + 0.06}, false}), covers("-86.562 degrees to 183.438"));
  EXPECT_EQ(refusal(makeScan(0.1, 0.01, 600)), covers("5.72958 degrees to 348.931")) << "a gap of 16 degrees ahead";
  EXPECT_EQ(refusal(makeScan(-M_PI_2, kHalfDegree, 355)), "");
  EXPECT_EQ(refusal(makeScan(-M_PI_2, kHalfDegree, 353)), covers("-90 degrees to 86"));
  // Of wide increments half a one may be missing at each edge, more may not.
  EXPECT_EQ(refusal(makeScan(-85.1 * degree, 10.0 * degree, 18)), "");
  EXPECT_EQ(refusal(makeScan(-84.0 * degree, 10.0 * degree, 18)), covers("-84 degrees to 86"));
}

TEST(AverageSectors, RefusesUnusableGeometry) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string expected = ", expected finite angles and an increment other than 0 of at least 1e-5 rad";
  EXPECT_EQ(refusal(makeScan(-2.0, 0.01, 0)), "the scan has no ranges, expected at least one beam a sector");
  EXPECT_EQ(refusal(makeScan(nan, 0.01, 400)), "the scan has angle_min nan and angle_increment 0.01" + expected);
  EXPECT_EQ(refusal(makeScan(-2.0, 0.0, 400)), "the scan has angle_min -2 and angle_increment 0" + expected);
  EXPECT_NE(refusal(makeScan(-2.0, 1.0, 5)).find("at least one beam in each sector"), std::string::npos);
  EXPECT_EQ(refusal(makeHokuyoScan(), {{nan, 0.0, 0.0}, false}), "the pose of the scanner on the robot is not finite");
  LaserScan scan = makeHokuyoScan();
  scan.range_max = 0.01;
  EXPECT_EQ(refusal(scan),
            "the scan has range_min 0.023 and range_max 0.01, expected 0 or more, and range_min below range_max");
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] { averageSectors(makeHokuyoScan(), {}, {}, 0.0); }),
            "the range cap is 0 m, expected a positive finite distance");
}

TEST(AverageSectors, RefusesNumbersThatNoScannerHas) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(makeScan(inf, 0.01, 400)), HasSubstr("expected finite angles"));
  EXPECT_THAT(refusal(makeScan(1e30, 0.01, 400)), HasSubstr("expected finite angles"));
  EXPECT_THAT(refusal(makeScan(-2.0, inf, 400)), HasSubstr("expected finite angles"));
  EXPECT_THAT(refusal(makeScan(-2.0, 1e-45, 400)), HasSubstr("an increment other than 0 of at least 1e-5 rad"));
  EXPECT_THAT(refusal(makeScan(-2.0, 0.01, 100001)), HasSubstr("100001 ranges, expected at most 100000"));
  EXPECT_THAT(refusal(makeHokuyoScan(), {{1e9, 0.0, 0.0}, false}), HasSubstr("expected at most 100 m"));
  EXPECT_THAT(refusal(makeHokuyoScan(), {{0.0, 0.0, 1e300}, false}), HasSubstr("expected at most two turns"));
  LaserScan scan = makeHokuyoScan();
  scan.range_max = 0.0;
  EXPECT_THAT(refusal(scan), HasSubstr("expected 0 or more, and range_min below range_max"));
  scan.range_max = 60.0;
  scan.range_min = inf;
  EXPECT_THAT(refusal(scan), HasSubstr("range_min inf"));
}

TEST(AverageSectors, RefusesAScanOfWhichNothingWasMeasured) {
  for (const float reading : {kNan, 0.0f, 0.01f, -kInf, 61.0f}) {
    EXPECT_THAT(refusal(makeHokuyoScan(reading)), HasSubstr("0 of 90 beams measured")) << reading;
  }
  EXPECT_THAT(refusal(makeHokuyoScan(0.01f), {}, urgNodeRules()), HasSubstr("0 of 90 beams measured"))
      << "a hand on the lens";
}

TEST(AverageSectors, TakesAnOpenFieldByEitherConvention) {
  EXPECT_EQ(refusal(makeHokuyoScan(kInf)), "");
  for (const float reading : {kNan, 0.0f, 65.53f, 61.0f}) {
    EXPECT_EQ(refusal(makeHokuyoScan(reading), {}, urgNodeRules()), "") << reading;
  }
}

TEST(AverageSectors, RefusesASectorOfWhichLessThanTheLeastShareWasMeasured) {
  LaserScan scan = makeHokuyoScan(2.0f);
  for (std::size_t beam = 270; beam < 270 + 45; ++beam) scan.ranges[beam] = kNan;  // half of sector 1
  EXPECT_EQ(refusal(scan), "");
  scan.ranges[270 + 45] = kNan;
  EXPECT_THAT(refusal(scan), HasSubstr("44 of 90 beams measured from -67.5 degrees to -45 degrees"));
  ScanRules tolerant;
  tolerant.least_measured = 0.4;
  EXPECT_EQ(refusal(scan, {}, tolerant), "");
}

TEST(AverageSectors, SaysThatSomethingIsTooNearWhereTheReadingsSaySo) {
  LaserScan scan = makeHokuyoScan(2.0f);
  for (std::size_t beam = 270; beam < 270 + 50; ++beam) scan.ranges[beam] = -kInf;  // of the 90 beams of sector 1
  EXPECT_THAT(refusal(scan), HasSubstr(": 50 readings of the scan are -inf, which means that something is nearer than "
                                       "range_min (REP-117)"));
  EXPECT_THAT(refusal(scan), Not(HasSubstr("no_return"))) << "-inf is none of the readings that it may list";
  scan.ranges[0] = kNan;
  EXPECT_THAT(refusal(scan), HasSubstr("(REP-117): the scanner is covered, or its driver sends other readings"));
}

TEST(AverageSectors, SaysThatRangeMinIsTooLargeWhereMostThatIsNotMeasuredIsBelowIt) {
  LaserScan scan = makeHokuyoScan(2.0f);
  scan.range_min = 0.4;
  for (std::size_t beam = 270; beam < 270 + 50; ++beam) scan.ranges[beam] = 0.3f;  // of the 90 beams of sector 1
  EXPECT_THAT(refusal(scan), HasSubstr(": 50 readings of the scan are below range_min = 0.4 m"));
  EXPECT_THAT(refusal(scan), Not(HasSubstr("no_return"))) << "as no returns they would make the robot drive into it";
  for (std::size_t beam = 400; beam < 460; ++beam) scan.ranges[beam] = kNan;
  EXPECT_THAT(refusal(scan), HasSubstr(": the scanner is covered, or its driver sends other readings"));
}

TEST(AverageSectors, DoesNotMindWhatIsNotMeasuredBehindTheRobot) {
  LaserScan scan = makeHokuyoScan(2.0f);
  for (std::size_t beam = 0; beam < 180; ++beam) scan.ranges[beam] = kNan;
  EXPECT_EQ(refusal(scan), "");
}

}  // namespace
}  // namespace lstm_planner::test_sectors
