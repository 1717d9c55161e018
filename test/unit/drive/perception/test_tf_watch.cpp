#include <gtest/gtest.h>

#include "lstm_planner/drive/perception/tf_watch.hpp"

namespace lstm_planner::test_tf_watch {
namespace {

/// At `speed` for `seconds`, with tf `beside` the topic's pose and `late` by so many s; whether it was noticed at last.
bool drive(TfWatch* watch, double begin, double seconds, double speed, double beside, double late = 0.0) {
  constexpr double kPeriod = 0.25;  // s
  bool noticed = false;
  for (double stamp = begin; stamp <= begin + seconds; stamp += kPeriod) {
    noticed = watch->note(stamp, {speed * stamp, 0.0, 0.0}, {speed * (stamp - late), beside, 0.0}, speed);
  }
  return noticed;
}

TEST(TfWatch, NoticesAnotherOdometryOnceItHasBeenAnotherForASecond) {
  TfWatch watch;
  EXPECT_FALSE(drive(&watch, 100.0, 0.75, 0.5, 0.3));
  EXPECT_TRUE(drive(&watch, 101.0, 0.0, 0.5, 0.3));
}

TEST(TfWatch, TwoCellsOfACostmapAreTooFar) {
  TfWatch watch;
  EXPECT_FALSE(drive(&watch, 100.0, 10.0, 0.0, 0.09));
  EXPECT_TRUE(drive(&watch, 200.0, 10.0, 0.0, 0.11));
}

TEST(TfWatch, TfThatIsATenthOfASecondLateIsOfTheSameOdometry) {
  TfWatch watch;
  EXPECT_FALSE(drive(&watch, 100.0, 10.0, 2.0, 0.0, 0.1));
  EXPECT_FALSE(drive(&watch, 200.0, 10.0, -2.0, 0.0, 0.1));
}

TEST(TfWatch, AJumpThatOneOfThemTellsLaterIsNone) {
  TfWatch watch;
  for (double stamp = 100.0; stamp < 110.0; stamp += 1.0) {
    EXPECT_FALSE(drive(&watch, stamp, 0.5, 0.0, 3.0));
    EXPECT_FALSE(drive(&watch, stamp + 0.75, 0.0, 0.0, 0.0));
  }
}

TEST(TfWatch, AfterTheClockWasSetBackASecondBeginsAnew) {
  TfWatch watch;
  EXPECT_FALSE(drive(&watch, 100.0, 0.75, 0.0, 0.3));
  EXPECT_FALSE(drive(&watch, 10.0, 0.75, 0.0, 0.3));
  EXPECT_TRUE(drive(&watch, 11.0, 0.0, 0.0, 0.3));
}

}  // namespace
}  // namespace lstm_planner::test_tf_watch
