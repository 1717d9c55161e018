#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lstm_planner/drive/motion/shortfall_watch.hpp"

namespace lstm_planner::test_shortfall_watch {
namespace {

constexpr double kPeriod = 0.05;  // s
constexpr double kStep = 0.03;    // m/s

/// What is found in 10 s.
double found(const std::function<double(double time)>& measured, const std::function<double(double time)>& told) {
  ShortfallWatch watch;
  for (int i = 0; i < 200; ++i) watch.note(measured(i * kPeriod), told(i * kPeriod), kPeriod, kStep);
  return watch.shortBy();
}

TEST(ShortfallWatch, FindsNothingOnABaseThatDoesWhatItIsToldAfterAWhile) {
  // Speeds up in 0.5 s, goes on, brakes, stands: again and again. The base is 0.25 s late.
  const auto told = [](double time) {
    const double at = std::fmod(std::max(0.0, time), 2.0);
    return std::clamp(at < 1.0 ? 0.6 * at : 0.6 * (1.5 - at), 0.0, 0.3);
  };
  EXPECT_EQ(found([&](double time) { return told(time - 0.25); }, told), 0.0);
}

TEST(ShortfallWatch, FindsAtLeastWhatABaseLacks) {
  EXPECT_GE(found([](double) { return 0.12; }, [](double) { return 0.15; }), 0.06);
  EXPECT_NEAR(found([](double) { return 0.0; }, [](double) { return 0.13; }), 0.15, 1e-9)
      << "it stands: as much as is allowed";
  EXPECT_NEAR(found([](double) { return 0.8; }, [](double) { return 1.0; }), 0.4, 1e-9) << "half of the speed";
}

TEST(ShortfallWatch, ForgetsWhereTheBaseIsFastAgain) {
  ShortfallWatch watch;
  for (int i = 0; i < 100; ++i) watch.note(0.12, 0.15, kPeriod, kStep);
  EXPECT_GT(watch.shortBy(), 0.0);
  for (int i = 0; i < 100; ++i) watch.note(0.3, 0.3, kPeriod, kStep);
  EXPECT_LT(watch.shortBy(), 0.001);
}

}  // namespace
}  // namespace lstm_planner::test_shortfall_watch
