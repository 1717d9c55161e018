#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/drive/motion/stand_watch.hpp"

namespace lstm_planner::test_stand_watch {
namespace {

constexpr Point2 kGoal{3.0, 0.0};
constexpr double kPeriod = 0.1;              // s
constexpr double kOnce = 20.0 - 2.0 * M_PI;  // s, after it has been everywhere

class StandWatchTest : public ::testing::Test {
 protected:
  /// For 20 s; poseAt(time).
  template <typename PoseAt>
  double tried(const PoseAt& poseAt) {
    StandWatch watch;
    for (double time = 0.0; time < 20.0; time += kPeriod) watch.note(poseAt(time), time, kGoal, true);
    return watch.tried();
  }
};

TEST_F(StandWatchTest, ARobotThatTurnsToAndFroGetsAwayFromNothing) {
  EXPECT_GT(tried([](double time) { return Pose2{0.0, 0.0, 0.5 * std::sin(time)}; }), kOnce);
}

TEST_F(StandWatchTest, ARobotThatDrivesToAndFroGetsAwayFromNothing) {
  EXPECT_GT(tried([](double time) { return Pose2{0.1 * std::sin(time), 0.0, 0.3 * std::cos(time)}; }), kOnce);
}

TEST_F(StandWatchTest, ARobotThatIsWedgedAndTurnsThisWayAndThatGetsAwayFromNothing) {
  // As one did between furniture: it moves by some centimetres, and looks over an angle of 2.4 rad.
  EXPECT_GT(tried([](double time) {
              return Pose2{0.03 * std::sin(1.7 * time), 0.02 * std::cos(2.3 * time), 1.2 * std::sin(time)};
            }),
            kOnce);
}

TEST_F(StandWatchTest, ALookAroundAndAnyDriveOnAreNew) {
  EXPECT_LT(tried([](double time) { return Pose2{0.0, 0.0, normalizeAngle(0.5 * time)}; }), 1.0);
  EXPECT_LT(tried([](double time) { return Pose2{0.05 * time, 0.0, 0.0}; }), 3.0) << "10 cm take 2 s";
}

TEST_F(StandWatchTest, BackOutOfADeadEndIsSoonNew) {
  // 1 m in at 0.1 m/s, and out again: it remembers 8 places, 10 cm from each other.
  const double path = 0.1 * 10.0;
  EXPECT_LT(tried([&](double time) { return Pose2{path - std::abs(path - 0.1 * time), 0.0, 0.0}; }), 10.0);
}

TEST_F(StandWatchTest, CountsRetriesUntilItGetsAway) {
  StandWatch watch;
  watch.note({}, 0.0, kGoal, true);
  watch.note({}, 10.0, kGoal, true);
  watch.retry();
  EXPECT_EQ(watch.stood(), 0.0);
  watch.note({}, 15.0, kGoal, true);
  EXPECT_EQ(watch.stood(), 5.0);
  EXPECT_EQ(watch.retries(), 1);
  watch.note({0.11, 0.0, 0.0}, 16.0, kGoal, true);
  EXPECT_EQ(watch.retries(), 0);
}

TEST_F(StandWatchTest, ARobotThatSpinsGetsAwayFromNothing) {
  // As one whose motors are connected the wrong way round.
  StandWatch watch;
  for (double time = 0.0; time < 100.0; time += kPeriod) {
    watch.note({0.0, 0.0, normalizeAngle(1.5 * time)}, time, kGoal, true);
  }
  EXPECT_GT(watch.tried(), 50.0);
}

}  // namespace
}  // namespace lstm_planner::test_stand_watch
