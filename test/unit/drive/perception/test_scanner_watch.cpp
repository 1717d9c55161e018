#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "lstm_planner/drive/perception/scanner_watch.hpp"
#include "support/refusal.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_scanner_watch {
namespace {

class ScannerWatchTest : public ::testing::Test {
 protected:
  void hear(double time, float range = 2.0f) { hear(time, time, range); }
  void hear(double stamp, double received, float range) {
    watch_.hear(makeHokuyoScan(range), urgNodeRules(), stamp, received, pose_);
  }
  /// The odometry has.
  void jump(double time, const Pose2& pose) {
    pose_ = pose;
    watch_.noteJump(time, pose);
  }
  std::string refusal(double now) const {
    return test::refusalOf<SensorError>([&] { watch_.check(now); });
  }
  const float nothing_ = std::numeric_limits<float>::quiet_NaN();
  Pose2 pose_;
  ScannerWatch watch_{"/rear/scan", 0.0, 0.2};
};

TEST_F(ScannerWatchTest, OneThatIsSilentIsNamed) {
  EXPECT_EQ(refusal(100.0), "no scan has been received on /rear/scan");
}

TEST_F(ScannerWatchTest, OneThatFallsSilentIsNamedAfterThreeOfItsOwnPeriods) {
  for (int i = 0; i <= 8; ++i) hear(100.0 + 0.1 * i);
  EXPECT_NEAR(watch_.timeout(), 0.3, 1e-6);
  EXPECT_NO_THROW(watch_.check(101.05));
  const std::string said = refusal(101.15);
  EXPECT_EQ(said.rfind("the newest message on /rear/scan is 0.35", 0), 0u) << said;
  EXPECT_NE(said.find("allowed are scan_timeout = 0.3"), std::string::npos) << said;
}

TEST_F(ScannerWatchTest, OneThatIsCoveredIsNamed) {
  hear(100.0);
  hear(100.1, nothing_);
  EXPECT_EQ(refusal(100.1).rfind("the scanner counts as covered: on /rear/scan no beam", 0), 0u) << refusal(100.1);
}

TEST_F(ScannerWatchTest, ARobotThatIsPutElsewhereMayStandInAnOpenField) {
  const Pose2 elsewhere{5.0, 0.0, 0.0};
  hear(100.0);
  jump(100.19, elsewhere);
  hear(100.2, nothing_);
  EXPECT_EQ(refusal(100.2), "");
  hear(100.4);
  hear(100.6, nothing_);
  jump(100.61, {});
  EXPECT_EQ(refusal(100.6), "") << "the scan came before the odometry";
  hear(100.8);
  jump(100.9, elsewhere);
  hear(100.85, 100.95, 2.0f);
  hear(101.0, nothing_);
  EXPECT_EQ(refusal(101.0), "") << "a scan of before came after the odometry";
}

TEST_F(ScannerWatchTest, OneThatIsCoveredCountsAsCoveredWhenTheClockIsSetBack) {
  hear(100.0);
  hear(100.1, nothing_);
  jump(50.0, {0.1, 0.0, 0.0});
  hear(50.1, nothing_);
  EXPECT_NE(refusal(50.1), "");
  hear(50.2);
  hear(50.3, nothing_);
  EXPECT_NE(refusal(50.3), "");
}

TEST_F(ScannerWatchTest, AClockThatWasSetBackIsToldFromOneThatDiffers) {
  hear(100.0);
  EXPECT_EQ(refusal(60.0),
            "the clock was set back by at least 40.000 s since the newest message on /rear/scan came: there is no new "
            "one yet");
  hear(100.0, 60.0, 2.0f);
  EXPECT_EQ(refusal(60.01).rfind("the newest message on /rear/scan is stamped 39.990 s in the future", 0), 0u);
}

}  // namespace
}  // namespace lstm_planner::test_scanner_watch
