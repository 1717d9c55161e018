#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/practice/step_simulator.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_step_simulator {
namespace {

const CircleWorld kEmptyField({});

LoopEnd driveStraight(const World& world, const PracticeConditions& conditions, double distance) {
  const DriveTask task{{1.0, 2.0, 0.5}, pointAlong(Point2{1.0, 2.0}, 0.5, distance), distance};
  NavigationAgent agent(test::straightAheadPolicy(), practiceAgent(test::straightAheadPolicy().description()));
  StepSimulator drive(world, task, conditions, 1);
  const LoopEnd end = drive.run(300, &agent);
  EXPECT_EQ(drive.contacts(), 0);
  if (end == LoopEnd::kArrived) {
    EXPECT_LE(distanceBetween(drive.truePose(), task.goal), 0.2 + 1e-9) << "the controller's tolerance";
    EXPECT_NEAR(drive.pathLength(), distance, 0.25);
  }
  return end;
}

TEST(StepSimulator, ArrivesStraightAheadInTheOpen) {
  EXPECT_EQ(driveStraight(kEmptyField, usualConditions(), 5.0), LoopEnd::kArrived);
}

TEST(StepSimulator, StopsInFrontOfAnObstacle) {
  const CircleWorld pole({{pointAlong(Point2{1.0, 2.0}, 0.5, 3.0), 1.0}});
  EXPECT_EQ(driveStraight(pole, usualConditions(), 6.0), LoopEnd::kStopped);
}

TEST(StepSimulator, LetsTheOdometryErr) {
  PracticeConditions conditions = usualConditions();
  conditions.travel_error = 0.05;
  const DriveTask task{{0.0, 0.0, 0.0}, {10.0, 0.0}, 10.0};
  NavigationAgent agent(test::straightAheadPolicy(), practiceAgent(test::straightAheadPolicy().description()));
  StepSimulator drive(kEmptyField, task, conditions, 1);
  ASSERT_EQ(drive.run(300, &agent), LoopEnd::kArrived) << "as far as the odometry can tell";
  // Arrived at 9.8 to 10 m by an odometry that counts 5 % too much.
  EXPECT_NEAR(drive.truePose().x, 9.9 / 1.05, 0.2);
}

TEST(PracticeAgent, HasNoHelp) {
  const AgentParameters agent = practiceAgent(PolicyDescription());
  EXPECT_EQ(agent.leader, Leader::kNetwork);
  EXPECT_FALSE(agent.memory.enabled);
  EXPECT_FALSE(agent.escape.enabled) << "it is to learn to get out by itself";
}

TEST(StepSimulator, IsTheSameForTheSameSeed) {
  Random random(5);
  const PracticeConditions conditions = drawConditions(random);
  const DriveTask task{{0.0, 0.0, 0.3}, {4.0, 1.0}, 0.0};
  Pose2 ends[2];
  for (Pose2& end : ends) {
    NavigationAgent agent(test::straightAheadPolicy(), practiceAgent(test::straightAheadPolicy().description()));
    StepSimulator drive(kEmptyField, task, conditions, 7);
    drive.run(20, &agent);
    end = drive.truePose();
  }
  EXPECT_EQ(ends[0].x, ends[1].x);
  EXPECT_EQ(ends[0].y, ends[1].y);
  EXPECT_EQ(ends[0].yaw, ends[1].yaw);
}

}  // namespace
}  // namespace lstm_planner::test_step_simulator
