#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "lstm_planner/drive/decision/place_trace.hpp"

namespace lstm_planner::test_place_trace {
namespace {

constexpr auto kStep = PlaceTrace::kStep;

TEST(PlaceTrace, CountsHowOftenTheRobotCameIn) {
  PlaceTrace trace;
  EXPECT_EQ(trace.at(kStep, {0.1, 0.1}).count, 0);
  trace.visit({0.1, 0.1});
  trace.visit({0.4, 0.3});  // the same square of 0.5 m
  EXPECT_EQ(trace.at(kStep, {0.2, 0.2}).count, 1);
  trace.visit({-0.1, 0.1});
  trace.visit({0.1, 0.1});
  EXPECT_EQ(trace.at(kStep, {0.2, 0.2}).count, 2);
  EXPECT_EQ(trace.at(kStep, {-0.2, 0.2}).count, 1);
  EXPECT_EQ(trace.at(kStep, {-0.2, -0.2}).count, 0);
}

TEST(PlaceTrace, CountsEachScaleByItsOwnSquares) {
  PlaceTrace trace;
  trace.visit({0.1, 0.1});
  trace.visit({1.1, 0.1});  // another square of 0.5 m, the same of 1.5 m
  trace.visit({2.1, 0.1});  // another of 1.5 m, the same of 4.5 m
  EXPECT_EQ(trace.at(PlaceTrace::kStep, {1.1, 0.1}).count, 1);
  EXPECT_EQ(trace.at(PlaceTrace::kRoom, {0.7, 1.4}).count, 1);
  EXPECT_EQ(trace.at(PlaceTrace::kRoom, {1.7, 0.1}).count, 1);
  EXPECT_EQ(trace.at(PlaceTrace::kHall, {4.4, 4.4}).count, 1);
  EXPECT_EQ(trace.at(PlaceTrace::kHall, {4.6, 0.1}).count, 0);
}

TEST(PlaceTrace, CountsNoFurtherThanItsCap) {
  PlaceTrace trace;
  for (int i = 0; i < 300; ++i) {
    trace.visit({0.25, 0.25});
    trace.visit({0.75, 0.25});
  }
  EXPECT_EQ(trace.at(kStep, {0.25, 0.25}).count, PlaceTrace::kMostVisits);
}

TEST(PlaceTrace, TellsHowManyStepsAgoTheRobotWasThere) {
  PlaceTrace trace;
  trace.visit({0.25, 0.25});
  EXPECT_EQ(trace.at(kStep, {0.25, 0.25}).age, 0);
  for (int i = 0; i < 3; ++i) trace.visit({0.75, 0.25});
  EXPECT_EQ(trace.at(kStep, {0.25, 0.25}).age, 3);
  trace.visit({0.25, 0.25});
  EXPECT_EQ(trace.at(kStep, {0.25, 0.25}).age, 0);
}

TEST(PlaceTrace, KeepsAgesApartThroughDrivesOfAnyLength) {
  PlaceTrace trace;
  constexpr int kSteps = 100000;
  for (int step = 0; step < kSteps; ++step) {
    if (step == kSteps - 5000) trace.visit({9.25, 0.25});
    trace.visit({step % 2 == 0 ? 0.25 : 0.75, 0.25});
  }
  EXPECT_EQ(trace.at(kStep, {9.25, 0.25}).age, 5000);
  EXPECT_EQ(trace.at(kStep, {0.25, 0.25}).age, 1);
}

TEST(PlaceTrace, CountsWhatIsLongAgoAsItsLongestAgeAtLeast) {
  PlaceTrace trace;
  trace.visit({9.25, 0.25});
  for (int step = 0; step < 50000; ++step) {
    trace.visit({0.25, 0.25});
    ASSERT_GE(trace.at(kStep, {9.25, 0.25}).age, std::min(step + 1, PlaceTrace::kLongestAge));
  }
}

TEST(PlaceTrace, ForgetsAPlaceWhenAnotherTakesItsEntry) {
  PlaceTrace trace;
  const double window = (1 << PlaceTrace::kWindowBits[kStep]) * PlaceTrace::kCellSizes[kStep];
  trace.visit({0.25, 0.25});
  EXPECT_EQ(trace.at(kStep, {0.25 - window, 0.25}).count, 0) << "a window away it was never";
  trace.visit({0.25 - window, 0.25});
  EXPECT_EQ(trace.at(kStep, {0.25 - window, 0.25}).count, 1);
  EXPECT_EQ(trace.at(kStep, {0.25, 0.25}).count, 0);
}

TEST(PlaceTrace, ForgetsEverythingWhenCleared) {
  PlaceTrace trace;
  trace.visit({0.25, 0.25});
  trace.clear();
  EXPECT_EQ(trace.at(kStep, {0.25, 0.25}).count, 0);
  trace.visit({0.25, 0.25});
  EXPECT_EQ(trace.at(kStep, {0.25, 0.25}).count, 1);
}

TEST(PlaceTrace, IgnoresPlacesThatAreNowhere) {
  PlaceTrace trace;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  trace.visit({nan, 0.0});
  trace.visit({1e300, 0.0});
  EXPECT_EQ(trace.at(kStep, {nan, 0.0}).count, 0);
  EXPECT_EQ(trace.at(kStep, {1e300, 0.0}).count, 0);
}

}  // namespace
}  // namespace lstm_planner::test_place_trace
