#include <gtest/gtest.h>

#include "ros/create2_stub/schedule.hpp"

namespace lstm_planner::test_schedule {
namespace {

constexpr std::uint64_t kMillisecond = 1'000'000;                     // ns
constexpr std::uint64_t kSecond = 1000 * kMillisecond;                // ns
constexpr std::uint64_t kFiftyYears = 50ULL * 365 * 86400 * kSecond;  // ns

TEST(ScheduleTest, IsDueOnceAPeriod) {
  Schedule schedule(40.0);
  schedule.restart(kSecond);
  EXPECT_FALSE(schedule.due(kSecond - 1));
  EXPECT_TRUE(schedule.due(kSecond));
  EXPECT_FALSE(schedule.due(kSecond + 24 * kMillisecond));
  EXPECT_TRUE(schedule.due(kSecond + 25 * kMillisecond));
  EXPECT_TRUE(schedule.due(kSecond + 120 * kMillisecond)) << "three periods were left out";
  EXPECT_FALSE(schedule.due(kSecond + 124 * kMillisecond));
  EXPECT_TRUE(schedule.due(kSecond + 125 * kMillisecond));
}

TEST(ScheduleTest, GoesOnAtOnceWhenTheClockIsSet) {
  Schedule schedule(40.0);
  EXPECT_TRUE(schedule.due(kFiftyYears));  // the clock of a computer without a battery, until it is set
  EXPECT_FALSE(schedule.due(kFiftyYears + 24 * kMillisecond));
  EXPECT_TRUE(schedule.due(kFiftyYears + 25 * kMillisecond));
}

}  // namespace
}  // namespace lstm_planner::test_schedule
