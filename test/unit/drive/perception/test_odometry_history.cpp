#include <gtest/gtest.h>

#include "lstm_planner/drive/perception/odometry_history.hpp"
#include "support/heap_count.hpp"

namespace lstm_planner::test_odometry_history {
namespace {

TEST(OdometryHistory, KeepsABoundedNumberOfEntriesWhereStampsHardlyGoOn) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  OdometryHistory history(1.0);
  const long before = heapCount().live_bytes;
  for (int i = 0; i < 100000; ++i) history.add({5.0 + 1e-9 * i, {}, {}});
  EXPECT_LT(heapCount().live_bytes - before, 1 << 20);
  EXPECT_EQ(history.jumps(), 0);
}

TEST(OdometryHistory, ContinuesAtTheSpeedOfTheRobotWhereMessagesComeInABunch) {
  // 0.5 m/s at 50 Hz, but the last two were read from the wire at once.
  OdometryHistory history(1.0);
  for (const double stamp : {0.0, 0.02, 0.04, 0.06, 0.08}) history.add({stamp, {0.5 * stamp, 0.0, 0.0}, {}});
  history.add({0.0801, {0.05, 0.0, 0.0}, {}});
  EXPECT_NEAR(history.poseAt(0.1).x, 0.06, 0.01);
  EXPECT_NEAR(history.poseAt(10.0).x, 0.05 + 0.5 * 0.2, 0.05);
}

TEST(OdometryHistory, DoesNotTellASpeedFromTwoMessagesOfABunch) {
  OdometryHistory history(1.0);
  history.add({0.0, {}, {}});
  history.add({1e-4, {0.01, 0.0, 0.0}, {}});
  EXPECT_EQ(history.poseAt(0.1).x, 0.01);
}

TEST(OdometryHistory, TakesTheFirstPoseForWhateverWasBefore) {
  OdometryHistory history(1.0);
  history.add({1.0, {0.5, 0.0, 0.0}, {}});
  EXPECT_EQ(history.poseAt(0.9).x, 0.5);
  EXPECT_EQ(history.poseAt(1.1).x, 0.5) << "one message tells no speed";
  history.add({1.1, {0.55, 0.0, 0.0}, {}});
  EXPECT_EQ(history.poseAt(0.9).x, 0.5);
}

/// A board behind a serial line (rosserial) asks for the time now and then, and corrects its clock.
TEST(OdometryHistory, ForgetsNothingWhenADriverCorrectsItsClock) {
  OdometryHistory history(1.0);
  for (const double stamp : {0.0, 0.02, 0.04, 0.03, 0.05}) history.add({stamp, {0.5 * stamp, 0.0, 0.0}, {}});
  EXPECT_EQ(history.jumps(), 0);
  EXPECT_NEAR(history.poseAt(0.01).x, 0.005, 1e-9);
  history.add({-0.5, {}, {}});
  EXPECT_EQ(history.jumps(), 1) << "the clock was set back";
}

/// robot_localization with smooth_lagged_data stamps a message as early as the measurement that came late.
TEST(OdometryHistory, ForgetsNothingWhenAnEkfGoesBackToALateMeasurement) {
  OdometryHistory history(1.0);
  for (const double stamp : {1.0, 1.03, 0.8, 1.06}) history.add({stamp, {0.5 * stamp, 0.0, 0.0}, {}});
  EXPECT_EQ(history.jumps(), 0);
  EXPECT_NEAR(history.poseAt(1.045).x, 0.5 * 1.045, 1e-9);
}

TEST(OdometryHistory, NoticesThatTheOdometryStartedAgainAfterAPause) {
  OdometryHistory history(1.0);
  history.add({0.0, {4.0, 0.0, 0.0}, {}});
  history.add({5.0, {4.0, 0.0, 0.0}, {}});
  EXPECT_EQ(history.jumps(), 0) << "it stood";
  history.add({10.0, {0.0, 0.0, 0.0}, {}});
  EXPECT_EQ(history.jumps(), 1) << "without odometry nothing drives it by 4 m";
}

}  // namespace
}  // namespace lstm_planner::test_odometry_history
