#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lstm_planner/agent/place_trace.hpp"

namespace lstm_planner {
namespace {

TEST(PlaceTrace, CountsHowOftenTheRobotCameIn) {
  PlaceTrace trace;
  EXPECT_EQ(trace.at({0.1, 0.1}), 0);
  trace.visit({0.1, 0.1});
  trace.visit({0.4, 0.3});  // the same square of 0.5 m
  EXPECT_EQ(trace.at({0.2, 0.2}), 1);
  trace.visit({-0.1, 0.1});
  trace.visit({0.1, 0.1});
  EXPECT_EQ(trace.at({0.2, 0.2}), 2);
  EXPECT_EQ(trace.at({-0.2, 0.2}), 1);
  EXPECT_EQ(trace.at({-0.2, -0.2}), 0);
}

TEST(PlaceTrace, CountsNoFurtherThanItsCap) {
  PlaceTrace trace;
  for (int i = 0; i < 300; ++i) {
    trace.visit({0.25, 0.25});
    trace.visit({0.75, 0.25});
  }
  EXPECT_EQ(trace.at({0.25, 0.25}), PlaceTrace::kMostVisits);
}

TEST(PlaceTrace, LooksAroundCounterClockwiseFromTheHeading) {
  PlaceTrace trace;
  trace.visit({0.25, 1.05});  // 0.8 m to the north of the robot
  const Pose2 facing_east{0.25, 0.25, 0.0};
  const Pose2 facing_north{0.25, 0.25, M_PI_2};
  const auto east = trace.around(facing_east, 0.8);
  const auto north = trace.around(facing_north, 0.8);
  for (std::size_t i = 0; i < east.size(); ++i) {
    EXPECT_EQ(east[i], i == 2 ? 1.0 : 0.0) << i;
    EXPECT_EQ(north[i], i == 0 ? 1.0 : 0.0) << i;
  }
}

TEST(PlaceTrace, ForgetsAPlaceWhenAnotherTakesItsEntry) {
  PlaceTrace trace;
  const double window = PlaceTrace::kWindow * PlaceTrace::kCellSize;
  trace.visit({0.25, 0.25});
  EXPECT_EQ(trace.at({0.25 - window, 0.25}), 0) << "a window away it was never";
  trace.visit({0.25 - window, 0.25});
  EXPECT_EQ(trace.at({0.25 - window, 0.25}), 1);
  EXPECT_EQ(trace.at({0.25, 0.25}), 0);
}

TEST(PlaceTrace, ForgetsEverythingWhenCleared) {
  PlaceTrace trace;
  trace.visit({0.25, 0.25});
  trace.clear();
  EXPECT_EQ(trace.at({0.25, 0.25}), 0);
  trace.visit({0.25, 0.25});
  EXPECT_EQ(trace.at({0.25, 0.25}), 1);
}

TEST(PlaceTrace, IgnoresPlacesThatAreNowhere) {
  PlaceTrace trace;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  trace.visit({nan, 0.0});
  trace.visit({1e300, 0.0});
  EXPECT_EQ(trace.at({nan, 0.0}), 0);
  EXPECT_EQ(trace.at({1e300, 0.0}), 0);
}

TEST(PlaceTrace, StaysSmall) { EXPECT_LE(PlaceTrace::bytes(), 25000u); }

}  // namespace
}  // namespace lstm_planner
