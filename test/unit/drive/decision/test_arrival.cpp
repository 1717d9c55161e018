// Where a drive to a goal in or behind an obstacle ends, and whether that counts as arrived.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lstm_planner/drive/decision/arrival.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "support/agent_steps.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_arrival {
namespace {

using Move = Decision::Move;

const Pose2 kGoal{2.0, 0.0, 0.3};

/// Odometry so bad that a goal may lie half a metre from where it is after a metre.
AgentParameters badOdometry(bool counts) {
  AgentParameters parameters = test::routeLed();
  parameters.goal_drift = 0.5;
  parameters.arrive_beside_goal = counts;
  return parameters;
}

std::vector<Point2> ringAroundTheGoal(double radius) {
  std::vector<Point2> points;
  for (const Point2& point : test::ring(radius)) points.push_back({kGoal.x + point.x, kGoal.y + point.y});
  return points;
}

/// A drive of 1.35 m, after which a closed ring is seen around the goal.
class DriveToTheRing {
 public:
  explicit DriveToTheRing(bool counts) : agent_(test::straightAheadPolicy(), badOdometry(counts)) {
    agent_.setGoal({kGoal.x, kGoal.y});
    for (const double x : {-1.35, -0.9, -0.45}) test::decideIn(test::returnsAt({}, {x, 0.0, 0.0}), &agent_);
    look({});
  }

  Decision look(const Pose2& pose) {
    situation_ = test::returnsAt(ringAroundTheGoal(0.45), pose);
    return test::decideIn(situation_, &agent_);
  }
  Decision arrive() {
    const Point2 end = agent_.decision().destination;
    return look({end.x, end.y, 0.0});
  }
  std::vector<Pose2> plan() const {
    std::vector<Pose2> plan;
    rollOut(situation_, agent_.decision(), agent_.shield(), kGoal, agent_.parameters(), {}, &plan);
    return plan;
  }
  const NavigationAgent& agent() const { return agent_; }

 private:
  NavigationAgent agent_;
  Situation situation_;
};

TEST(Arrival, APlanToAGoalInAnObstacleEndsWhereTheRobotHasArrived) {
  DriveToTheRing drive(true);
  ASSERT_TRUE(drive.agent().endsBesideGoal());
  const Point2 end = drive.agent().decision().destination;
  EXPECT_EQ(drive.plan().back().x, end.x);
  EXPECT_EQ(drive.plan().back().yaw, kGoal.yaw);
  EXPECT_EQ(drive.arrive().choice, Move::kArrived);
}

TEST(Arrival, WhereThatDoesNotCountThePlanLeadsToTheGoalAndThereIsNoPathInTheEnd) {
  DriveToTheRing drive(false);
  ASSERT_TRUE(drive.agent().endsBesideGoal());
  const Point2 end = drive.agent().decision().destination;
  const std::vector<Pose2> plan = drive.plan();
  // No local planner may take the end of the path for the goal.
  EXPECT_EQ(plan.back().x, kGoal.x);
  EXPECT_EQ(plan.back().y, kGoal.y);
  double nearest = 1.0;
  for (const Pose2& pose : plan) nearest = std::min(nearest, distanceBetween(pose, end));
  EXPECT_LT(nearest, 0.03) << "on the way it leads where the robot can go";
  EXPECT_EQ(drive.arrive().choice, Move::kNoPath);
  EXPECT_TRUE(drive.agent().endsBesideGoal());
  EXPECT_EQ(drive.look({}).choice, Move::kNoPath) << "until there is another goal";
}

TEST(Arrival, AGoalThatCanBeReachedIsReachedEitherWay) {
  for (const bool counts : {true, false}) {
    AgentParameters parameters = test::routeLed();
    parameters.arrive_beside_goal = counts;
    NavigationAgent agent(test::straightAheadPolicy(), parameters);
    agent.setGoal({2.0, 0.0});
    EXPECT_EQ(test::decideIn(test::returnsAt({}, {1.9, 0.0, 0.0}), &agent).choice, Move::kArrived) << counts;
    EXPECT_FALSE(agent.endsBesideGoal());
  }
}

TEST(Arrival, AGoalSeemsToLieInAnObstacleAlsoWhereTheEndOfThePathIsInSight) {
  DriveToTheRing drive(true);
  EXPECT_EQ(drive.agent().decision().goal_seems, Decision::GoalSeems::kInObstacle);
  const Point2 end = drive.agent().decision().destination;
  const Decision& decision = drive.look({end.x - 0.4, end.y, 0.0});
  EXPECT_EQ(decision.choice, Move::kGoalInSight);
  EXPECT_EQ(decision.goal_seems, Decision::GoalSeems::kInObstacle);
}

TEST(Arrival, InSimulationADriveIntoAClosedBoxEndsAsInTheRobot) {
  OccupancyGrid grid = test::emptyHall(8.0, 4.0);
  test::fillBox(5.6, 1.6, 6.4, 2.4, &grid);
  const GridWorld world(grid);
  const auto end = [&](bool counts) {
    AgentParameters parameters = test::routeLed();
    parameters.goal_drift = 0.2;
    parameters.arrive_beside_goal = counts;
    NavigationAgent agent(test::straightAheadPolicy(), parameters);
    DriveParameters drive_parameters = test::quickDrive(60.0);
    drive_parameters.goal_radius = 1.0;
    return drive(world, {{1.0, 2.0, 0.0}, {6.0, 2.0}}, drive_parameters, 1, &agent).end;
  };
  EXPECT_EQ(end(true), DriveResult::End::kReached);
  EXPECT_EQ(end(false), DriveResult::End::kNoPath);
}

TEST(Arrival, IsToldInOneSentence) {
  EXPECT_EQ(besideGoalText(1.3162),
            "stopped 1.32 m from the goal, which seems to lie in or behind an obstacle (goal_drift)");
}

}  // namespace
}  // namespace lstm_planner::test_arrival
