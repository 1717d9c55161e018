#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "robot/perception/reading_bounds.hpp"
#include "robot/perception/scan_kernels.hpp"
#include "support/instruction_sets.hpp"

namespace lstm_planner::test_beam_kernels {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// What a LaserScan's readings, with the rules of urg_node, may be: mostly walls, and everything else there is.
std::vector<float> someReadings(std::size_t count, double share_of_odd_ones, std::mt19937* random) {
  const std::vector<float> odd = {kNan, 0.0f, -1.0f, 0.01f, 61.0f, 65.53f, 65.6f, kInf, -kInf, 60.0f, 0.023f};
  std::uniform_real_distribution<float> wall(0.05f, 30.0f);
  std::bernoulli_distribution is_odd(share_of_odd_ones);
  std::uniform_int_distribution<std::size_t> which(0, odd.size() - 1);
  std::vector<float> readings(count);
  for (float& reading : readings) reading = is_odd(*random) ? odd[which(*random)] : wall(*random);
  return readings;
}

template <typename Number>
bool areSame(const std::vector<Number>& a, const std::vector<Number>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Number)) == 0;
}

class BeamKernelsOf : public ::testing::TestWithParam<InstructionSet> {
 protected:
  template <typename Ask>
  void forManyScans(const Ask& ask) {
    for (const double share : {0.0, 0.02, 0.5}) {
      for (const std::size_t count : {1, 7, 8, 9, 31, 100, 1081}) ask(someReadings(count, share, &random_));
    }
  }

  std::vector<float> rangesOf(const std::vector<float>& readings, const ScanKernels& kernels) const {
    LaserScan scan;
    scan.range_min = 0.023;
    scan.range_max = 60.0;
    std::vector<float> ranges(readings.size());
    kernels.meanings(readingBounds(scan, urgNodeRules()), readings.data(), readings.size(), ranges.data());
    return ranges;
  }

  const ScanKernels& kernels_ = scanKernels(GetParam());
  const ScanKernels& baseline_ = scanKernels(InstructionSet::kBaseline);
  std::mt19937 random_{7};
};

TEST_P(BeamKernelsOf, TakeEachReadingForWhatItMeansAlone) {
  forManyScans([&](const std::vector<float>& readings) {
    const std::vector<float> ranges = rangesOf(readings, kernels_);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      ASSERT_EQ(ranges[i], rangesOf({readings[i]}, baseline_).front()) << "reading " << readings[i];
    }
  });
}

TEST_P(BeamKernelsOf, AddUpWhatIsKnownAndRoundAsTheBaselineDoes) {
  constexpr double kCap = 6.0;
  forManyScans([&](const std::vector<float>& readings) {
    const std::vector<float> ranges = rangesOf(readings, baseline_);
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
    const BeamSum sum = kernels_.sum(ranges.data(), ranges.size(), kCap);
    ASSERT_EQ(sum.known, expected.known);
    ASSERT_EQ(sum.measured, expected.measured);
    ASSERT_EQ(sum.silent, expected.silent);
    ASSERT_EQ(sum.nearest, expected.nearest);
    ASSERT_NEAR(sum.range, expected.range, 1e-9);  // 1081 roundings of sums of up to 6486 m
    ASSERT_EQ(sum.range, baseline_.sum(ranges.data(), ranges.size(), kCap).range);
  });
}

TEST_P(BeamKernelsOf, PlaceReturnsInTheOrderOfTheBeamsAndRoundAsTheBaselineDoes) {
  constexpr double kNearest = 0.023;
  const double origin[2] = {0.13, -0.02};
  forManyScans([&](const std::vector<float>& readings) {
    const std::vector<float> ranges = rangesOf(readings, baseline_);
    std::vector<double> directions;
    std::vector<double> expected;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double direction = -2.356 + 0.00436 * static_cast<double>(i);
      const double range = ranges[i] == -kInf ? kNearest : ranges[i];
      directions.insert(directions.end(), {std::cos(direction), std::sin(direction)});
      if (!(range > 0.0) || !std::isfinite(range)) continue;
      expected.push_back(origin[0] + range * std::cos(direction));
      expected.push_back(origin[1] + range * std::sin(direction));
    }
    const auto pointsOf = [&](const ScanKernels& kernels) {
      std::vector<double> points(directions.size());
      points.resize(2 *
                    kernels.points(ranges.data(), ranges.size(), kNearest, origin, directions.data(), points.data()));
      return points;
    };
    const std::vector<double> points = pointsOf(kernels_);
    ASSERT_EQ(points.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_NEAR(points[i], expected[i], 1e-13);
    ASSERT_TRUE(areSame(points, pointsOf(baseline_)));
  });
}

INSTANTIATE_TEST_SUITE_P(Sets, BeamKernelsOf, ::testing::ValuesIn(runnableInstructionSets()), test::instructionSetName);

}  // namespace
}  // namespace lstm_planner::test_beam_kernels
