#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/drive/perception/correction_watch.hpp"

namespace lstm_planner::test_correction_watch {
namespace {

TEST(CorrectionWatch, TheFirstTransformIsNoJump) {
  CorrectionWatch watch;
  EXPECT_EQ(watch.note({100.0, 50.0, 2.0}, {3.0, 4.0, 0.0}), 0.0);
  EXPECT_EQ(watch.jumps(), 0);
}

TEST(CorrectionWatch, ASmallCorrectionIsNoJump) {
  CorrectionWatch watch;
  watch.note({}, {10.0, 0.0, 0.0});
  EXPECT_NEAR(watch.note({0.3, 0.0, 0.0}, {10.5, 0.0, 0.0}), 0.3, 1e-12);
  EXPECT_EQ(watch.jumps(), 0);
}

TEST(CorrectionWatch, ATurnCountsByWhatItDoesToTheRobot) {
  CorrectionWatch watch;
  watch.note({}, {10.0, 0.0, 0.0});
  // The odometry frame turns by 0.2 rad about its origin, and 10 m away the robot moves by the chord.
  EXPECT_NEAR(watch.note({0.0, 0.0, 0.2}, {10.0, 0.0, 0.0}), 20.0 * std::sin(0.1), 1e-12);
  EXPECT_EQ(watch.jumps(), 1);
}

TEST(CorrectionWatch, ARobotThatIsFoundElsewhereHasJumped) {
  CorrectionWatch watch;
  watch.note({}, {});
  watch.note({1.01, 0.0, 0.0}, {});
  EXPECT_EQ(watch.jumps(), 1);
  watch.note({1.01, 0.0, 0.51}, {});
  EXPECT_EQ(watch.jumps(), 2) << "turned on the spot";
  watch.note({1.01, 0.0, 0.51}, {5.0, 0.0, 0.0});
  EXPECT_EQ(watch.jumps(), 2) << "the robot drove, the correction is the same";
}

}  // namespace
}  // namespace lstm_planner::test_correction_watch
