#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "lstm_planner/simulation/hokuyo.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_hokuyo {
namespace {

HokuyoParameters exact() {
  HokuyoParameters parameters;
  parameters.noise = 0.0;
  parameters.dropout = 0.0;
  return parameters;
}

/// A thin pillar straight ahead of the origin, another one to its left.
CircleWorld pillars() { return CircleWorld({{{3.0, 0.0}, 0.1}, {{0.0, 5.0}, 0.1}}); }

TEST(Hokuyo, ReportsTheDriversScan) {
  LaserScan scan;
  Hokuyo(exact(), 1).scan(pillars(), {}, 12.5, &scan);
  EXPECT_EQ(scan.stamp, 12.5);
  ASSERT_EQ(scan.ranges.size(), 1081u);
  EXPECT_EQ(scan.range_min, 0.023);
  EXPECT_EQ(scan.range_max, 60.0);
  // Beam 540 looks ahead, beam 900 to the left.
  EXPECT_NEAR(scan.ranges[540], 2.9, 1e-5);
  EXPECT_NEAR(scan.ranges[900], 4.9, 1e-5);
  EXPECT_TRUE(std::isinf(scan.ranges[700])) << "nothing there";
}

TEST(Hokuyo, LooksFromItsMount) {
  HokuyoParameters parameters = exact();
  parameters.mount = {{0.5, 0.0, 0.0}, true};
  LaserScan scan;
  // The robot stands at (0, 3) and looks north; its scanner hangs upside down at (0, 3.5): the pillar at (0, 5) is
  // ahead.
  Hokuyo(parameters, 1).scan(CircleWorld({{{0.0, 5.0}, 0.1}, {{2.0, 3.5}, 0.1}}), {0.0, 3.0, M_PI_2}, 0.0, &scan);
  EXPECT_NEAR(scan.ranges[540], 1.4, 1e-5);
  EXPECT_NEAR(scan.ranges[900], 1.9, 1e-5) << "the robot's right is the left of a scanner upside down";
}

TEST(Hokuyo, SeesNoFartherThanItsSight) {
  HokuyoParameters parameters = exact();
  parameters.sight = 2.5;
  LaserScan scan;
  Hokuyo(parameters, 1).scan(pillars(), {}, 0.0, &scan);
  EXPECT_TRUE(std::isinf(scan.ranges[540]));
}

/// What one beam says over and over again.
struct Readings {
  int count = 0;
  int dropped = 0;
  double mean = 0.0;
  double deviation = 0.0;
};

Readings readOften(Hokuyo* hokuyo, const World& world, std::size_t beam, int count) {
  Readings readings;
  LaserScan scan;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < count; ++i) {
    hokuyo->scan(world, {}, 0.0, &scan);
    const double range = scan.ranges[beam];
    if (std::isnan(range)) {
      ++readings.dropped;
      continue;
    }
    ++readings.count;
    sum += range;
    squares += range * range;
  }
  readings.mean = sum / readings.count;
  readings.deviation = std::sqrt(squares / readings.count - readings.mean * readings.mean);
  return readings;
}

TEST(Hokuyo, SpreadsAndDropsRangesAsItIsTold) {
  HokuyoParameters parameters;
  parameters.noise = 0.02;
  parameters.dropout = 0.1;
  Hokuyo hokuyo(parameters, 5);
  constexpr int kScans = 4000;
  const Readings readings = readOften(&hokuyo, pillars(), 540, kScans);
  // Four standard errors of a share of 0.1, of a mean and of a standard deviation.
  EXPECT_NEAR(readings.dropped, 0.1 * kScans, 4.0 * std::sqrt(0.1 * 0.9 * kScans));
  EXPECT_NEAR(readings.mean, 2.9, 4.0 * 0.02 / std::sqrt(readings.count));
  EXPECT_NEAR(readings.deviation, 0.02, 4.0 * 0.02 / std::sqrt(2.0 * readings.count));
}

TEST(Hokuyo, IsThreeTimesAsNoisyBeyondTenMetres) {
  HokuyoParameters parameters = exact();
  parameters.noise = 0.01;
  Hokuyo hokuyo(parameters, 5);
  const CircleWorld world({{{10.5, 0.0}, 0.1}, {{0.0, 9.5}, 0.1}});
  constexpr int kScans = 2000;
  const double error = 4.0 / std::sqrt(2.0 * kScans);  // relative, four standard errors
  EXPECT_NEAR(readOften(&hokuyo, world, 540, kScans).deviation, 0.03, 0.03 * error);
  EXPECT_NEAR(readOften(&hokuyo, world, 900, kScans).deviation, 0.01, 0.01 * error);
}

TEST(Hokuyo, RoundsRangesToMultiplesOfTheStep) {
  HokuyoParameters parameters = exact();
  parameters.range_step = 0.02;
  Hokuyo hokuyo(parameters, 5);
  const CircleWorld world({{{1.0, 0.0}, 0.109}, {{0.0, 1.0}, 0.111}});
  EXPECT_NEAR(readOften(&hokuyo, world, 540, 1).mean, 0.90, 1e-6) << "0.891 m";
  EXPECT_NEAR(readOften(&hokuyo, world, 900, 1).mean, 0.88, 1e-6) << "0.889 m";
}

TEST(Hokuyo, RepeatsItselfForTheSameSeed) {
  HokuyoParameters parameters;
  parameters.dropout = 0.2;
  Hokuyo a(parameters, 9);
  Hokuyo b(parameters, 9);
  Hokuyo c(parameters, 10);
  LaserScan scan_a;
  LaserScan scan_b;
  LaserScan scan_c;
  for (int i = 0; i < 3; ++i) {
    a.scan(pillars(), {}, 0.0, &scan_a);
    b.scan(pillars(), {}, 0.0, &scan_b);
    c.scan(pillars(), {}, 0.0, &scan_c);
  }
  // Compared as bytes: drop-outs are NaN.
  const std::size_t bytes = scan_a.ranges.size() * sizeof(float);
  EXPECT_EQ(std::memcmp(scan_a.ranges.data(), scan_b.ranges.data(), bytes), 0);
  EXPECT_NE(std::memcmp(scan_a.ranges.data(), scan_c.ranges.data(), bytes), 0);
}

TEST(Hokuyo, RefusesImpossibleParameters) {
  HokuyoParameters parameters;
  const auto refusal = [&] { return test::refusalOf<std::invalid_argument>([&] { Hokuyo(parameters, 1); }); };
  parameters.beams = 0;
  EXPECT_EQ(refusal(), "parameter beams is 0, expected a number in [1, 100000]");
  parameters = {};
  parameters.range_max = 0.0;
  EXPECT_EQ(refusal(), "parameter range_max is 0, expected a distance above range_min");
}

}  // namespace
}  // namespace lstm_planner::test_hokuyo
