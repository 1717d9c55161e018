#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"

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
  EXPECT_THROW(ActionSet(std::vector<double>{}), std::invalid_argument);
  EXPECT_THROW(ActionSet({0.0}), std::invalid_argument);
  EXPECT_THROW(ActionSet({0.5, -0.5}), std::invalid_argument);
  EXPECT_THROW(ActionSet({0.5, 0.5}), std::invalid_argument);
  EXPECT_THROW(ActionSet({0.0, 3.2}), std::invalid_argument);
  EXPECT_THROW(ActionSet({nan, 0.5}), std::invalid_argument);
  EXPECT_THROW(ActionSet({0.5, nan}), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_action_set
