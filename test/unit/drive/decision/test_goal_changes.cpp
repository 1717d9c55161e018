#include <gtest/gtest.h>

#include "lstm_planner/drive/decision/goal_changes.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_goal_changes {
namespace {

using Fresh = GoalChanges::Fresh;

class GoalChangesTest : public ::testing::Test {
 protected:
  GoalChangesTest() : agent_(test::straightAheadPolicy(), test::routeLed()) {
    agent_.perceive(test::returnsAt({{1.0, 1.0}}));
    EXPECT_EQ(tell({4.0, 0.0}, true), Fresh::kNewGoal);
    agent_.decide();
    EXPECT_FALSE(agent_.rememberedObstacles().empty());
  }

  Fresh tell(const Pose2& goal, bool is_new = false, long jumps = 0) {
    return changes_.tell(&agent_, goal, odometry_, is_new, jumps);
  }

  NavigationAgent agent_;
  GoalChanges changes_;
  Pose2 odometry_;  ///< its frame, in the agent's
};

TEST_F(GoalChangesTest, AGoalThatIsCorrectedALittleIsFollowed) {
  EXPECT_EQ(tell({4.0, 0.0}), Fresh::kNo);
  EXPECT_EQ(tell({4.2, 0.0}), Fresh::kNo);
  EXPECT_EQ(agent_.goal().x, 4.2);
  EXPECT_EQ(agent_.decision().step, 1) << "the drive goes on";
}

TEST_F(GoalChangesTest, AnotherHeadingOfTheGoalIsFollowed) {
  EXPECT_EQ(tell({4.0, 0.0, 1.0}), Fresh::kNo);
  EXPECT_EQ(changes_.goal().yaw, 1.0);
}

TEST_F(GoalChangesTest, AGoalThatMovesFartherIsAnotherOne) {
  EXPECT_EQ(tell({4.3, 0.0}), Fresh::kGoalMoved);
  EXPECT_EQ(agent_.decision().step, 0);
  EXPECT_FALSE(agent_.rememberedObstacles().empty()) << "what was seen stays";
}

TEST_F(GoalChangesTest, AGoalStaysWhereItIsWhenTheOdometryDrifts) {
  odometry_ = {0.0, 0.5, M_PI_2};
  EXPECT_EQ(tell({4.0, 0.0}), Fresh::kNo);
  EXPECT_EQ(agent_.goal().x, 4.0);
  EXPECT_EQ(agent_.goal().y, 0.0);
}

TEST_F(GoalChangesTest, AGoalThatIsGivenAfterADriftIsWhereTheOdometrySaysNow) {
  odometry_ = {0.0, 0.5, M_PI_2};
  EXPECT_EQ(tell({3.0, 1.0, 0.2}, true), Fresh::kNewGoal);
  EXPECT_NEAR(agent_.goal().x, -1.0, 1e-9);
  EXPECT_NEAR(agent_.goal().y, 3.5, 1e-9);
  EXPECT_NEAR(changes_.goal().yaw, M_PI_2 + 0.2, 1e-9);
}

TEST_F(GoalChangesTest, AJumpIsToldOnceAndForgetsWhatWasSeen) {
  EXPECT_EQ(tell({4.0, 0.0}, false, 1), Fresh::kJump);
  EXPECT_TRUE(agent_.rememberedObstacles().empty());
  EXPECT_EQ(tell({4.0, 0.0}, false, 1), Fresh::kNo);
}

}  // namespace
}  // namespace lstm_planner::test_goal_changes
