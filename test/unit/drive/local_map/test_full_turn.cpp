#include <gtest/gtest.h>

#include "lstm_planner/drive/local_map/full_turn.hpp"

namespace lstm_planner::test_full_turn {
namespace {

/// Turns at that speed (rad/s), or to and fro, until it is over; s.
double secondsUntilOver(double speed, bool to_and_fro = false) {
  FullTurn turn;
  double yaw = 3.0;
  double time = 100.0;
  turn.start(yaw, time);
  for (int tick = 0; !turn.isOver() && tick < 1000; ++tick) {
    const double way = to_and_fro && tick % 2 == 1 ? -1.0 : 1.0;
    yaw = normalizeAngle(yaw + way * 0.1 * speed);
    time += 0.1;
    turn.note(yaw, time);
  }
  return time - 100.0;
}

TEST(FullTurn, IsOverWhenEverythingIsSeenWhateverTheWay) {
  // 2 pi - 0.5 rad, in steps of 0.1 s.
  EXPECT_NEAR(secondsUntilOver(1.0), 5.8, 0.1);
  EXPECT_NEAR(secondsUntilOver(-1.0), 5.8, 0.1);
  EXPECT_NEAR(secondsUntilOver(0.1), 57.8, 0.1) << "however slowly";
}

TEST(FullTurn, IsOverAfterFiveSecondsWithoutProgress) {
  EXPECT_NEAR(secondsUntilOver(0.0), 5.1, 0.11);
  EXPECT_NEAR(secondsUntilOver(1.0, true), 5.1, 0.11) << "to and fro by 0.1 rad";
}

TEST(FullTurn, BeginsAnew) {
  FullTurn turn;
  turn.start(0.0, 0.0);
  turn.note(0.0, 10.0);
  ASSERT_TRUE(turn.isOver());
  turn.start(0.0, 10.0);
  turn.note(0.1, 11.0);
  EXPECT_FALSE(turn.isOver());
}

}  // namespace
}  // namespace lstm_planner::test_full_turn
