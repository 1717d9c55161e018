#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_action_set {
namespace {

TEST(ActionSet, HasTheSteeringAnglesOfTheThesis) {
  const ActionSet actions;
  ASSERT_EQ(actions.size(), 5);
  const double degrees[] = {-90.0, -45.0, 0.0, 45.0, 90.0};
  for (int action = 0; action < 5; ++action) {
    EXPECT_DOUBLE_EQ(actions.angle(action), degreesToRadians(degrees[action]));
  }
}

TEST(ActionSet, FindsTheNearestAngle) {
  const ActionSet actions;
  EXPECT_EQ(actions.nearest(0.0), 2);
  EXPECT_EQ(actions.nearest(degreesToRadians(22.0)), 2);
  EXPECT_EQ(actions.nearest(degreesToRadians(23.0)), 3);
  EXPECT_EQ(actions.nearest(degreesToRadians(-67.0)), 1);
  EXPECT_EQ(actions.nearest(degreesToRadians(-68.0)), 0);
}

TEST(ActionSet, TakesTheOutermostAngleForWhatLiesBehind) {
  const ActionSet actions;
  EXPECT_EQ(actions.nearest(degreesToRadians(179.0)), 4);
  EXPECT_EQ(actions.nearest(degreesToRadians(-179.0)), 0);
  // The same directions with another number of turns.
  EXPECT_EQ(actions.nearest(degreesToRadians(181.0)), 0);
  EXPECT_EQ(actions.nearest(degreesToRadians(-181.0)), 4);
  EXPECT_EQ(actions.nearest(degreesToRadians(361.0)), 2);
}

TEST(ActionSet, LooksForTheNearestAcrossTheCut) {
  const ActionSet actions({-3.0, 0.0, 1.0});
  EXPECT_EQ(actions.nearest(3.1), 0);  // 0.18 rad from -3, 2.1 rad from 1
}

TEST(ActionSet, RefusesSetsThatCannotBeChosenFrom) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [](const std::vector<double>& angles) {
    return test::refusalOf<std::invalid_argument>([&] { ActionSet{angles}; });
  };
  EXPECT_EQ(refusal({}), "the action set has 0 steering angles, at least two are needed");
  EXPECT_EQ(refusal({0.0}), "the action set has 1 steering angles, at least two are needed");
  const std::string expected = ", expected ascending angles within [-pi, pi]";
  EXPECT_EQ(refusal({0.5, -0.5}), "steering angle 1 is -0.5" + expected);
  EXPECT_EQ(refusal({0.5, 0.5}), "steering angle 1 is 0.5" + expected);
  EXPECT_EQ(refusal({0.0, 3.2}), "steering angle 1 is 3.2" + expected);
  EXPECT_EQ(refusal({nan, 0.5}), "steering angle 0 is nan" + expected);
  EXPECT_EQ(refusal({0.5, nan}), "steering angle 1 is nan" + expected);
}

}  // namespace
}  // namespace lstm_planner::test_action_set
