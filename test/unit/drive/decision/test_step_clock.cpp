#include <gtest/gtest.h>

#include "lstm_planner/drive/decision/step_clock.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_step_clock {
namespace {

using test::situationAt;

const Point2 kWaypoint{0.4, 0.0};

TEST(StepClock, AStepIsDrivenAfterItsLengthOrTurnOrAtTheWaypoint) {
  const StepParameters step;
  EXPECT_FALSE(isStepDriven(step, {}, {0.0, 0.39, 0.78}, kWaypoint));
  EXPECT_TRUE(isStepDriven(step, {}, {0.0, 0.4, 0.0}, kWaypoint));
  EXPECT_TRUE(isStepDriven(step, {}, {0.0, 0.0, -0.79}, kWaypoint));
  EXPECT_TRUE(isStepDriven(step, {}, {0.36, 0.0, 0.0}, kWaypoint));
}

TEST(StepClock, AStepIsOverAfterItsPeriodIfTheRobotHasMoved) {
  StepClock clock{StepParameters()};
  EXPECT_FALSE(clock.hasStep());
  clock.start(situationAt({}, 10.0));
  EXPECT_TRUE(clock.hasStep());
  EXPECT_FALSE(clock.isOver(situationAt({}, 10.6), kWaypoint));
  EXPECT_FALSE(clock.isOver(situationAt({0.1, 0.0, 0.0}, 10.4), kWaypoint));
  EXPECT_TRUE(clock.isOver(situationAt({0.1, 0.0, 0.0}, 10.5), kWaypoint));
  EXPECT_TRUE(clock.isOver(situationAt({0.1, 0.0, 0.0}, 3.0), kWaypoint)) << "the clock jumped back";
  clock.clear();
  EXPECT_FALSE(clock.hasStep());
}

TEST(StepClock, SaysOnceInAWhileThatTheRobotStandsStill) {
  StepClock clock{StepParameters()};
  clock.start(situationAt({}, 0.0));
  EXPECT_FALSE(clock.isStalled(situationAt({}, 1.9)));
  EXPECT_TRUE(clock.isStalled(situationAt({0.005, 0.0, 0.0}, 2.1)));
  EXPECT_EQ(clock.stalls(), 1);
  EXPECT_FALSE(clock.isStalled(situationAt({}, 4.0)));
  EXPECT_TRUE(clock.isStalled(situationAt({}, 4.2)));
  EXPECT_EQ(clock.stalls(), 2);
  EXPECT_FALSE(clock.isStalled(situationAt({0.1, 0.0, 0.0}, 7.0))) << "it has moved";
  EXPECT_EQ(clock.stalls(), 0);
}

}  // namespace
}  // namespace lstm_planner::test_step_clock
