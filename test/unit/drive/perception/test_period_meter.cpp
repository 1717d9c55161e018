#include <gtest/gtest.h>

#include "lstm_planner/drive/perception/period_meter.hpp"

namespace lstm_planner::test_period_meter {
namespace {

constexpr double kFloor = 0.2;   // s
constexpr double kExact = 1e-9;  // s

TEST(PeriodMeter, KnowsNothingUntilSomeMessagesHaveCome) {
  PeriodMeter meter;
  for (int i = 0; i < 4; ++i) meter.note(100.0 + 0.2 * i);
  EXPECT_EQ(meter.period(), 0.0);
  meter.note(100.8);
  EXPECT_NEAR(meter.period(), 0.2, kExact);
}

TEST(PeriodMeter, LostMessagesDoNotMatter) {
  PeriodMeter meter;
  double stamp = 100.0;
  for (int i = 0; i < 30; ++i) {
    stamp += i % 3 == 0 ? 0.025 : 0.075;
    meter.note(stamp);
  }
  EXPECT_NEAR(meter.period(), 0.025, kExact);
}

TEST(PeriodMeter, PausesAndClocksThatAreSetBackAreNoPeriods) {
  PeriodMeter meter;
  for (const double stamp : {100.0, 100.1, 100.2, 160.2, 160.3, 20.0, 20.0, 20.1, 20.2}) meter.note(stamp);
  EXPECT_NEAR(meter.period(), 0.1, kExact);
}

TEST(PeriodMeter, FollowsASensorThatChangesItsRate) {
  PeriodMeter meter;
  double stamp = 0.0;
  for (int i = 0; i < 20; ++i) meter.note(stamp += 0.1);
  for (int i = 0; i < 20; ++i) meter.note(stamp += 0.2);
  EXPECT_NEAR(meter.period(), 0.2, kExact);
}

TEST(TimeoutFor, IsWhatIsSet) { EXPECT_EQ(timeoutFor(0.15, 0.2, kFloor), 0.15); }

TEST(TimeoutFor, IsThreePeriodsUnlessThatIsVeryShortOrLong) {
  EXPECT_EQ(timeoutFor(0.0, 0.025, kFloor), kFloor);
  EXPECT_NEAR(timeoutFor(0.0, 0.2, kFloor), 0.6, kExact);  // a TurtleBot3's scanner, at 5 Hz
  EXPECT_EQ(timeoutFor(0.0, 0.8, kFloor), 1.0);
}

TEST(TimeoutFor, IsTheShortestAsLongAsThePeriodIsNotKnown) { EXPECT_EQ(timeoutFor(0.0, 0.0, kFloor), kFloor); }

}  // namespace
}  // namespace lstm_planner::test_period_meter
