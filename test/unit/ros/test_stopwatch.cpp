#include <gtest/gtest.h>

#include "ros/common/timing.hpp"

namespace lstm_planner::test_stopwatch {
namespace {

class StopwatchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ros::Time::init();
    setClock(100.0);
    stopwatch_.restart();
  }
  // Other tests of this process have the computer's clock.
  void TearDown() override { ros::Time::useSystemTime(); }
  static void setClock(double seconds) { ros::Time::setNow(ros::Time(seconds)); }

  Stopwatch stopwatch_;
};

TEST_F(StopwatchTest, TellsWhetherTimeHasPassed) {
  setClock(102.0);
  EXPECT_FALSE(stopwatch_.isLongerAgo(2.0));
  EXPECT_TRUE(stopwatch_.isLongerAgo(1.9));
}

TEST_F(StopwatchTest, StartsAnewWhenTheClockIsSetBack) {
  setClock(40.0);
  EXPECT_FALSE(stopwatch_.isLongerAgo(2.0));
  setClock(42.5);
  EXPECT_TRUE(stopwatch_.isLongerAgo(2.0)) << "and not after 62 s";
}

TEST_F(StopwatchTest, StartsWhenThereIsATime) {
  setClock(0.0);
  stopwatch_.restart();
  EXPECT_FALSE(stopwatch_.isLongerAgo(2.0));
  setClock(100.5);
  EXPECT_FALSE(stopwatch_.isLongerAgo(2.0)) << "a simulation whose clock begins at 100 s";
  setClock(103.0);
  EXPECT_TRUE(stopwatch_.isLongerAgo(2.0));
}

}  // namespace
}  // namespace lstm_planner::test_stopwatch
