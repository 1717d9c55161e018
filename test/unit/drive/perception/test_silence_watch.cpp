#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/drive/perception/silence_watch.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_silence_watch {
namespace {

constexpr double kPeriod = 0.1;  // s

class SilenceWatchTest : public ::testing::Test {
 protected:
  /// Shows a scan of the same readings everywhere.
  bool isCoveredAfter(float reading) {
    time_ += kPeriod;
    watch_.show(makeHokuyoScan(reading), rules_, time_, pose_);
    return watch_.isCovered();
  }

  const float nan_ = std::numeric_limits<float>::quiet_NaN();
  ScanRules rules_ = urgNodeRules();
  SilenceWatch watch_;
  double time_ = 100.0;
  Pose2 pose_;
};

TEST_F(SilenceWatchTest, ALensThatIsCoveredIsNoticedUntilItSeesAgain) {
  EXPECT_FALSE(isCoveredAfter(3.0f));
  EXPECT_TRUE(isCoveredAfter(nan_));
  EXPECT_DOUBLE_EQ(watch_.shareBefore(), 1.0);
  time_ += 60.0;
  EXPECT_TRUE(isCoveredAfter(0.0f)) << "however long it lasts, and in another of the driver's codes";
  EXPECT_FALSE(isCoveredAfter(3.0f));
}

TEST_F(SilenceWatchTest, AnOpenFieldFromTheBeginningIsNoCover) {
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(isCoveredAfter(nan_));
}

TEST_F(SilenceWatchTest, AScannerThatFailsIsNoticedWhereItsDriverSendsInfinity) {
  rules_ = ScanRules();
  EXPECT_FALSE(isCoveredAfter(3.0f));
  EXPECT_TRUE(isCoveredAfter(std::numeric_limits<float>::infinity()));
  EXPECT_FALSE(isCoveredAfter(3.0f));
}

TEST_F(SilenceWatchTest, SomebodyWhoPassesAScannerOfFewBeamsIsNoCover) {
  LaserScan scan = makeScan(-M_PI_2, M_PI / 8.0, 9, nan_);
  scan.ranges[3] = scan.ranges[4] = 1.0f;
  watch_.show(scan, rules_, time_, pose_);
  watch_.show(makeScan(-M_PI_2, M_PI / 8.0, 9, nan_), rules_, time_ + kPeriod, pose_);
  EXPECT_FALSE(watch_.isCovered());
}

TEST_F(SilenceWatchTest, ReadingsThatAreNoReturnsByNoRuleAreLeftToTheCheckOfTheScan) {
  rules_ = ScanRules();
  EXPECT_FALSE(isCoveredAfter(3.0f));
  EXPECT_FALSE(isCoveredAfter(nan_));
}

TEST_F(SilenceWatchTest, AScanWithoutBeamsIsLeftToTheCheckOfTheScan) {
  EXPECT_FALSE(isCoveredAfter(3.0f));
  watch_.show(LaserScan(), rules_, time_ + kPeriod, pose_);
  EXPECT_FALSE(watch_.isCovered());
}

TEST_F(SilenceWatchTest, AScannerWithoutReachIsLeftToTheCheckOfTheScan) {
  EXPECT_FALSE(isCoveredAfter(3.0f));
  LaserScan scan = makeHokuyoScan(3.0f);
  scan.range_max = 0.0;  // so all readings are beyond it
  watch_.show(scan, rules_, time_ + kPeriod, pose_);
  EXPECT_FALSE(watch_.isCovered());
}

TEST_F(SilenceWatchTest, ALensThatIsCoveredWhileTheScannerPausesIsNoticed) {
  EXPECT_FALSE(isCoveredAfter(3.0f));
  time_ += 60.0;
  pose_ = {0.3, 0.0, 0.5};  // until it stood for want of scans
  EXPECT_TRUE(isCoveredAfter(nan_));
  EXPECT_DOUBLE_EQ(watch_.shareBefore(), 1.0);
}

TEST_F(SilenceWatchTest, ALensThatIsCoveredWhenTheClockIsSetBackIsNoticed) {
  EXPECT_FALSE(isCoveredAfter(3.0f));
  time_ -= 50.0;
  EXPECT_TRUE(isCoveredAfter(nan_));
}

TEST_F(SilenceWatchTest, ARobotThatWasMovedInAPauseMayStandInAnOpenField) {
  EXPECT_FALSE(isCoveredAfter(3.0f));
  time_ += 1.0;
  pose_ = {0.6, 0.0, 0.0};
  EXPECT_FALSE(isCoveredAfter(nan_)) << "driven";
  EXPECT_FALSE(isCoveredAfter(nan_)) << "nor is the next scan compared with the one before the pause";
  EXPECT_FALSE(isCoveredAfter(3.0f));
  time_ += 1.0;
  pose_.yaw = 0.7;
  EXPECT_FALSE(isCoveredAfter(nan_)) << "turned";
}

TEST_F(SilenceWatchTest, ScansOfASlowScannerAreComparedWhileTheRobotDrivesFast) {
  const auto driveOn = [&] {
    time_ += 0.25;  // 0.35 s from scan to scan
    pose_.x += 0.7;
  };
  for (int i = 0; i < 6; ++i) {
    driveOn();
    EXPECT_FALSE(isCoveredAfter(3.0f));
  }
  driveOn();
  EXPECT_TRUE(isCoveredAfter(nan_));
}

TEST_F(SilenceWatchTest, TurningAndDrivingAwayFromTheLastWallIsNoCover) {
  // A wall of 20 m and nothing else within range.
  const CircleWorld wall([] {
    std::vector<Circle> posts;
    for (int i = 0; i < 200; ++i) posts.push_back({{2.0, -10.0 + 0.1 * i}, 0.1});
    return posts;
  }());
  HokuyoParameters parameters;
  parameters.sight = 5.0;
  Hokuyo hokuyo(parameters, 1);
  LaserScan scan;
  Pose2 pose;
  for (int i = 0; i < 120; ++i) {
    pose.yaw = std::min(M_PI, 2.0 * kPeriod * i);  // as fast as the robot can
    if (pose.yaw >= M_PI) pose.x -= 0.3 * kPeriod;
    time_ += kPeriod;
    hokuyo.scan(wall, pose, time_, &scan);
    std::replace(scan.ranges.begin(), scan.ranges.end(), std::numeric_limits<float>::infinity(), nan_);
    watch_.show(scan, rules_, time_, pose);
    ASSERT_FALSE(watch_.isCovered()) << "scan " << i;
  }
}

}  // namespace
}  // namespace lstm_planner::test_silence_watch
