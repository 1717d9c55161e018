#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/drive/decision/decision.hpp"

namespace lstm_planner::test_decision {
namespace {

TEST(Decision, MovesToAnotherFrameWithAllItsPlaces) {
  Decision decision;
  decision.waypoint = {1.0, 0.0};
  decision.destination = {3.0, 1.0};
  decision.direction = 3.0;
  decision.path_on = {{2.0, 0.0}, {3.0, 1.0}};
  const Decision moved = inParentFrame({10.0, 20.0, M_PI_2}, decision);  // x there is y here
  EXPECT_NEAR(moved.waypoint.x, 10.0, 1e-9);
  EXPECT_NEAR(moved.waypoint.y, 21.0, 1e-9);
  EXPECT_NEAR(moved.destination.x, 9.0, 1e-9);
  EXPECT_NEAR(moved.destination.y, 23.0, 1e-9);
  EXPECT_NEAR(moved.direction, 3.0 + M_PI_2 - 2.0 * M_PI, 1e-9) << "in (-pi, pi]";
  ASSERT_EQ(moved.path_on.size(), 2u);
  EXPECT_NEAR(moved.path_on[0].y, 22.0, 1e-9);
  EXPECT_NEAR(moved.path_on[1].x, 9.0, 1e-9);
}

}  // namespace
}  // namespace lstm_planner::test_decision
