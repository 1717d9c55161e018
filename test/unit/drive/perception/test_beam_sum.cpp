#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "drive/perception/beam_sum.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner::test_beam_sum {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// Mostly walls, and everything else that a RangeProfile may hold.
std::vector<float> someRanges(std::size_t count, double share_of_odd_ones, std::mt19937* random) {
  const std::vector<float> odd = {0.0f, RangeProfile::kSilent, kInf, -kInf};
  std::uniform_real_distribution<float> wall(0.05f, 30.0f);
  std::bernoulli_distribution is_odd(share_of_odd_ones);
  std::uniform_int_distribution<std::size_t> which(0, odd.size() - 1);
  std::vector<float> ranges(count);
  for (float& range : ranges) range = is_odd(*random) ? odd[which(*random)] : wall(*random);
  return ranges;
}

TEST(SumOfBeams, AddsUpWhatIsKnown) {
  constexpr double kCap = 6.0;
  std::mt19937 random(7);
  for (const double share : {0.0, 0.02, 0.5}) {
    for (const std::size_t count : {0, 1, 7, 8, 9, 31, 100, 1081}) {
      const std::vector<float> ranges = someRanges(count, share, &random);
      BeamSum expected{0.0, kInf, 0, 0, 0};
      for (const float range : ranges) {
        const bool is_silent = range == RangeProfile::kSilent;
        expected.silent += is_silent ? 1 : 0;
        if (!is_silent && !(range > 0.0f)) continue;
        ++expected.known;
        expected.range += is_silent ? kCap : std::min<double>(range, kCap);
        if (!is_silent) expected.nearest = std::min(expected.nearest, range);
        expected.measured += !is_silent && std::isfinite(range) ? 1 : 0;
      }
      const BeamSum sum = sumOfBeams(ranges.data(), count, kCap);
      EXPECT_EQ(sum.known, expected.known);
      EXPECT_EQ(sum.measured, expected.measured);
      EXPECT_EQ(sum.silent, expected.silent);
      EXPECT_EQ(sum.nearest, expected.nearest);
      EXPECT_NEAR(sum.range, expected.range, 1e-9);  // 1081 roundings of sums of up to 6486 m
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_beam_sum
