#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "drive/perception/beam_sum.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner::test_beam_sum {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(SumOfBeams, OfNothingIsNothing) {
  const BeamSum sum = sumOfBeams(nullptr, 0, 6.0);
  EXPECT_EQ(sum.range, 0.0);
  EXPECT_EQ(sum.nearest, kInf);
  EXPECT_EQ(sum.known + sum.measured, 0);
}

TEST(SumOfBeams, AddsUpWhatIsKnown) {
  // Two ranges, one of them beyond the cap; nothing seen; silent; and two that say nothing.
  const std::vector<float> ranges = {2.5f, 7.0f, kInf, RangeProfile::kSilent, 0.0f, -kInf};
  const BeamSum sum = sumOfBeams(ranges.data(), ranges.size(), 6.0);
  EXPECT_EQ(sum.range, 2.5 + 3 * 6.0);
  EXPECT_EQ(sum.nearest, 2.5f);
  EXPECT_EQ(sum.measured, 2);
  EXPECT_EQ(sum.known, 4);
}

TEST(SumOfBeams, CapsWithACapThatNoFloatIs) {
  const std::vector<float> ranges = {0.1f, 0.2f};
  EXPECT_EQ(sumOfBeams(ranges.data(), 2, 0.15).range, static_cast<double>(0.1f) + 0.15);
}

}  // namespace
}  // namespace lstm_planner::test_beam_sum
