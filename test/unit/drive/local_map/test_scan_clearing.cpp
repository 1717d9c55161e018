#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "lstm_planner/drive/local_map/scan_clearing.hpp"

namespace lstm_planner::test_scan_clearing {
namespace {

/// A scan of walls at many distances, with some beams that know nothing.
RangeProfile scanOf(double increment, std::size_t beams, std::mt19937* random) {
  RangeProfile profile;
  profile.first_direction = -2.3;
  profile.increment = increment;
  std::uniform_real_distribution<float> range(0.5f, 12.0f);
  std::bernoulli_distribution is_corner(0.05);
  float now = 5.0f;
  for (std::size_t i = 0; i < beams; ++i) {
    if (is_corner(*random)) now = range(*random);
    profile.ranges.push_back(i % 97 == 5 ? 0.0f : now);
  }
  return profile;
}

/// How far away a place in that direction (rad) may lie to be cleared, m.
double plainReach(const RangeProfile& profile, double towards) {
  const long beam = profile.beamTowards(towards);
  if (beam < 0) return -1.0;
  const long beams = static_cast<long>(profile.ranges.size());
  const bool goes_round = beams == 720;
  double nearest = 1e9;
  for (long i = 0; i < beams; ++i) {
    const long apart = std::abs(i - beam);
    if (apart <= 2 || (goes_round && apart >= beams - 2)) {
      nearest = std::min<double>(nearest, profile.ranges[static_cast<std::size_t>(i)]);
    }
  }
  return nearest - 0.1;
}

TEST(ScanClearing, ClearsWhatThePlainDefinitionClears) {
  constexpr double kResolution = 0.05;
  constexpr double kYaw = 1.1;
  constexpr int kSide = 480;
  constexpr double kCorner = -12.01;  // no square is just where the scanner is: it has no direction
  std::mt19937 random(5);
  for (const double increment : {0.00436332, -0.00436332, 2.0 * M_PI / 720.0}) {
    RangeProfile profile = scanOf(increment, increment < 0.006 ? 1081 : 720, &random);
    profile.ranges.back() = 0.7f;  // beside the first beam, where the scan goes all around
    ScanClearing clearing;
    clearing.show(profile, kYaw);
    int cleared = 0;
    for (int square = 0; square < kSide * kSide; ++square) {
      const double x = kCorner + square % kSide * kResolution;
      const double y = kCorner + square / kSide * kResolution;
      const double distance = std::hypot(x, y);
      const bool is_clear = clearing.isClear(static_cast<float>(x), static_cast<float>(y));
      cleared += is_clear ? 1 : 0;
      const double towards = std::atan2(y, x) - kYaw;
      const double a = plainReach(profile, towards - 3e-5);
      const double b = plainReach(profile, towards + 3e-5);
      if (distance < std::min(a, b) - 1e-4) {
        ASSERT_TRUE(is_clear) << x << ", " << y;
      }
      if (distance > std::max(a, b) + 1e-4) {
        ASSERT_FALSE(is_clear) << x << ", " << y;
      }
    }
    EXPECT_GT(cleared, 10000);
  }
}

TEST(ScanClearing, ClearsNothingWithoutBeams) {
  ScanClearing clearing;
  EXPECT_TRUE(clearing.isBlind());
  clearing.show(RangeProfile(), 0.0);
  EXPECT_TRUE(clearing.isBlind());
  EXPECT_FALSE(clearing.isClear(1.0f, 0.0f));
}

}  // namespace
}  // namespace lstm_planner::test_scan_clearing
