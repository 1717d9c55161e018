#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "support/agent_steps.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_navigation_routes {
namespace {

using Move = Decision::Move;
using test::returnsAt;
using test::situationAt;

/// A network that prefers straight on.
DrivePolicy stubbornPolicy() { return test::policyPreferring({1.0f, 2.0f, 5.0f, 3.0f, 4.0f}); }

class NavigationRoutes : public ::testing::Test {
 protected:
  NavigationRoutes() : agent_(stubbornPolicy(), test::routeLed()) { agent_.setGoal({4.0, 0.0}); }

  /// From the waypoint along the path on, m.
  static double lengthOn(const Decision& decision) {
    double length = 0.0;
    Point2 last = decision.waypoint;
    for (const Point2& point : decision.path_on) {
      length += distanceBetween(last, point);
      last = point;
    }
    return length;
  }

  NavigationAgent agent_;
  const AgentParameters defaults_ = test::routeLed();
};

/// Across the straight path; its right end is the nearer one.
const std::vector<Point2> kWall = test::wall({2.0, -1.0}, {2.0, 3.0});
const double kRoundTheWall = 2.0 * std::hypot(2.0, 1.0);  ///< m, at least, from the origin to (4, 0)

TEST_F(NavigationRoutes, TheWaypointLiesOnTheRouteThatLeads) {
  for (const double yaw : {0.0, 0.3, 1.0, M_PI}) {
    agent_.setGoal({4.0, 0.0});
    const Decision& decision = test::decideIn(situationAt({0.0, 0.0, yaw}), &agent_);
    EXPECT_EQ(decision.choice, Leader::kRoute);
    EXPECT_TRUE(decision.on_route);
    EXPECT_NEAR(decision.waypoint.x, 0.4, 1e-12);  // not where the heading points to
    EXPECT_NEAR(decision.waypoint.y, 0.0, 1e-12);
  }
}

TEST_F(NavigationRoutes, ARouteThatLeadsAsksNoNetwork) {
  const Network::HiddenState hidden = agent_.policy().hiddenState();
  for (int step = 0; step < 5; ++step) {
    const Decision& decision = test::decideIn(situationAt({0.4 * step, 0.0, 0.0}, step), &agent_);
    EXPECT_NE(decision.choice, Leader::kNetwork);
    EXPECT_EQ(decision.preferred, -1);
    EXPECT_EQ(decision.overruled, Overruled::kNo);
  }
  EXPECT_EQ(agent_.policy().hiddenState(), hidden);
}

TEST_F(NavigationRoutes, WithoutALeaderTheAllowedAngleNearestToTheGoalIsTaken) {
  AgentParameters parameters;
  parameters.leader = Leader::kGreedy;
  NavigationAgent agent(stubbornPolicy(), parameters);
  const double bearings[] = {-1.4, -0.7, 0.1, 0.9, 2.9};
  for (int action = 0; action < 5; ++action) {
    agent.setGoal(pointAlong(Point2{}, bearings[action], 5.0));
    const Decision& decision = test::decideIn(situationAt({}), &agent);
    EXPECT_EQ(decision.choice, Leader::kGreedy);
    EXPECT_EQ(decision.action, action);
    EXPECT_EQ(decision.preferred, -1);
  }
}

TEST_F(NavigationRoutes, ThePathOnGoesFromTheWaypointToTheDestination) {
  for (const double yaw : {0.0, -0.4, 1.0, 2.5}) {
    agent_.setGoal({4.0, 0.0});
    const Decision& decision = test::decideIn(returnsAt(kWall, {0.0, 0.0, yaw}), &agent_);
    ASSERT_FALSE(decision.path_on.empty()) << yaw;
    EXPECT_EQ(decision.path_on.back().x, 4.0);
    EXPECT_EQ(decision.path_on.back().y, 0.0);
    const double whole = distanceBetween(Point2{}, decision.waypoint) + lengthOn(decision);
    EXPECT_GT(whole, kRoundTheWall) << yaw;
    // Round the end at the footprint's radius and the comfortable clearance, and a cell more.
    const double aside = 1.0 + defaults_.shield.footprint_radius + defaults_.memory.comfort + 0.2;
    EXPECT_LT(whole, 2.0 * std::hypot(2.0, aside)) << yaw;
  }
}

TEST_F(NavigationRoutes, TheDestinationIsBesideAGoalThatLiesInSomething) {
  AgentParameters tolerant = test::routeLed();
  tolerant.goal_tolerance = 0.6;
  NavigationAgent agent(stubbornPolicy(), tolerant);
  const Point2 goal{4.0, 0.1};
  agent.setGoal(goal);
  EXPECT_EQ(agent.decision().destination.x, goal.x);
  std::vector<Point2> pillar;
  for (const Point2& point : test::ring(0.2)) pillar.push_back({goal.x + point.x, goal.y + point.y});
  const Decision& decision = test::decideIn(returnsAt(pillar), &agent);
  EXPECT_EQ(decision.goal_seems, Decision::GoalSeems::kReachable) << "within its tolerance";
  const double beside = distanceBetween(decision.destination, goal);
  EXPECT_GT(beside, 0.2 + 0.75 * tolerant.shield.footprint_radius);  // less what a square's rounding hides
  EXPECT_LE(beside, 0.6);
  ASSERT_FALSE(decision.path_on.empty());
  EXPECT_EQ(decision.path_on.back().x, decision.destination.x);
  // It stays there when the goal moves, until the path is found anew.
  const Point2 destination = decision.destination;
  agent.moveGoal({goal.x + 0.1, goal.y});
  EXPECT_EQ(agent.decision().destination.x, destination.x);
  EXPECT_EQ(agent.decision().path_on.back().x, destination.x);
  EXPECT_LE(distanceBetween(test::decideIn(returnsAt(pillar, {0.4, 0.0, 0.0}), &agent).destination, agent.goal()), 0.6);
}

TEST_F(NavigationRoutes, AGoalThatIsNearBehindALongWallSeemsToLieBehindAnObstacle) {
  const auto seems = [](double tolerance, const std::vector<Point2>& wall) {
    AgentParameters parameters = test::routeLed();
    parameters.goal_tolerance = tolerance;
    NavigationAgent agent(stubbornPolicy(), parameters);
    agent.setGoal({2.5, 0.0});
    return test::decideIn(returnsAt(wall), &agent).goal_seems;
  };
  // 12.6 m round the wall: more than three times the 2.8 m that count as near with this tolerance.
  const std::vector<Point2> long_wall = test::wall({2.0, -6.0}, {2.0, 6.0});
  EXPECT_EQ(seems(1.4, long_wall), Decision::GoalSeems::kBehindObstacle);
  EXPECT_EQ(seems(0.15, long_wall), Decision::GoalSeems::kReachable) << "odometry is too good for that";
  EXPECT_EQ(seems(1.4, kWall), Decision::GoalSeems::kReachable) << "the path is short";
}

TEST_F(NavigationRoutes, AGoalInAClosedRingSeemsEnclosed) {
  NavigationAgent agent(stubbornPolicy(), test::routeLed());
  agent.setGoal({3.0, 0.0});
  std::vector<Point2> ring;
  for (const Point2& point : test::ring(0.8)) ring.push_back({3.0 + point.x, point.y});
  EXPECT_EQ(test::decideIn(returnsAt(ring), &agent).goal_seems, Decision::GoalSeems::kEnclosed);
}

TEST_F(NavigationRoutes, AGoalInAClosedRingBesideTheRobotSeemsToLieInAnObstacle) {
  AgentParameters parameters = test::routeLed();
  parameters.goal_drift = 0.0;
  NavigationAgent agent(stubbornPolicy(), parameters);
  const Point2 goal{1.2, 0.0};  // within goal_in_sight
  agent.setGoal(goal);
  std::vector<Point2> box;
  for (const Point2& point : test::ring(0.3)) box.push_back({goal.x + point.x, goal.y + point.y});
  EXPECT_EQ(test::decideIn(returnsAt(box), &agent).goal_seems, Decision::GoalSeems::kInObstacle);
  EXPECT_EQ(agent.decision().choice, Decision::Move::kLookAround);
  EXPECT_DOUBLE_EQ(agent.reachedWithin(), parameters.goal_tolerance);
}

TEST_F(NavigationRoutes, AGoalThatTheRobotStandsBesideSeemsToLieBehindAnObstacleWhateverTheDrift) {
  NavigationAgent agent(stubbornPolicy(), test::routeLed());
  agent.setGoal({1.2, 0.0});
  // 12.2 m round the wall: more than three times goal_in_sight.
  const std::vector<Point2> long_wall = test::wall({0.7, -6.0}, {0.7, 6.0});
  EXPECT_EQ(test::decideIn(returnsAt(long_wall), &agent).goal_seems, Decision::GoalSeems::kBehindObstacle);
}

/// A goal in a pillar, shown to a robot that has driven up and down for so many steps. `tolerance`: a changed
/// goal_tolerance.
struct BesideThePillar {
  BesideThePillar(int steps, double tolerance) : agent(stubbornPolicy(), test::routeLed()) {
    AgentParameters changed = agent.parameters();
    changed.goal_tolerance = tolerance;
    agent.change(changed);
    const Point2 goal{8.0, 0.0};
    std::vector<Point2> pillar;
    for (const double radius : {0.3, 0.15}) {
      for (const Point2& point : test::ring(radius)) pillar.push_back({goal.x + point.x, point.y});
    }
    agent.setGoal({0.0, 9.0});
    test::decideIn(returnsAt({}), &agent);
    agent.setGoal(goal);  // what was driven before does not count
    for (int step = 0; step <= steps; ++step) {
      const Pose2 pose{step % 2 == 0 ? 4.0 : 4.5, 0.0, 0.0};
      Situation situation = step < steps ? returnsAt({}, pose) : returnsAt(pillar, pose);
      situation.time = 0.5 * step;
      test::decideIn(situation, &agent);
    }
    is_to_be_reached = agent.decision().choice == Leader::kRoute;
    end = distanceBetween(agent.decision().destination, goal);
  }

  NavigationAgent agent;
  bool is_to_be_reached;
  double end;  ///< m from the goal to the end of the path
};

TEST_F(NavigationRoutes, TheToleranceThatIsNamedIsTheOneThatEndsTheDrive) {
  const double tolerance = defaults_.goal_tolerance;
  const BesideThePillar far(100, tolerance);
  ASSERT_TRUE(far.is_to_be_reached);
  ASSERT_GT(far.end, 0.3 + defaults_.shield.footprint_radius);
  for (int steps = 0; steps < 40; ++steps) {
    const BesideThePillar drive(steps, tolerance);
    EXPECT_NEAR(drive.agent.reachedWithin(), tolerance + 0.5 * steps * defaults_.goal_drift, 1e-9);
    EXPECT_EQ(drive.is_to_be_reached, far.end <= drive.agent.reachedWithin()) << steps;
  }
}

TEST_F(NavigationRoutes, AToleranceThatIsChangedOnTheWayEndsTheDrive) {
  EXPECT_FALSE(BesideThePillar(0, 0.4).is_to_be_reached);
  EXPECT_TRUE(BesideThePillar(0, 0.8).is_to_be_reached);
}

TEST_F(NavigationRoutes, AGoalThatMovesALittleDoesNotMakeThePathJumpToTheOtherSide) {
  const std::vector<Point2> wall = test::wall({2.0, -1.1}, {2.0, 1.0});
  ASSERT_GT(test::decideIn(returnsAt(wall), &agent_).direction, 0.0) << "round the left end, which is the nearer one";
  const Point2 moved{4.0, -0.2};  // now the right end is
  agent_.moveGoal(moved);
  Situation on = returnsAt(wall, {0.03, 0.0, 0.0});
  on.time = 1.0;
  EXPECT_GT(test::decideIn(on, &agent_).direction, 0.0);
  EXPECT_EQ(agent_.decision().step, 2);
  agent_.setGoal(moved);
  EXPECT_LT(test::decideIn(on, &agent_).direction, 0.0) << "who sets out for it anew";
}

TEST_F(NavigationRoutes, AskingTwiceChangesNothing) {
  const Decision first = test::decideIn(returnsAt(kWall), &agent_);
  const Network::HiddenState hidden = agent_.policy().hiddenState();
  const Decision elsewhere = test::previewIn(returnsAt({}), {3.0, 0.0}, agent_);
  for (int i = 1; i < 10; ++i) {
    Situation again = returnsAt(kWall);
    again.time = 0.1 * i;
    const Decision& decision = test::decideIn(again, &agent_);
    EXPECT_EQ(decision.step, first.step);
    EXPECT_EQ(decision.waypoint.x, first.waypoint.x);
    EXPECT_EQ(decision.waypoint.y, first.waypoint.y);
    EXPECT_EQ(lengthOn(decision), lengthOn(first));
  }
  EXPECT_EQ(agent_.policy().hiddenState(), hidden);
  EXPECT_EQ(lengthOn(test::previewIn(returnsAt({}), {3.0, 0.0}, agent_)), lengthOn(elsewhere));
}

TEST_F(NavigationRoutes, APreviewKnowsWhatWasSeenAndLeavesNoTrace) {
  test::decideIn(returnsAt({}), &agent_);
  EXPECT_GT(lengthOn(test::previewIn(returnsAt(kWall), {4.0, 0.0}, agent_)), 2.0 * std::sqrt(5.0) - 0.4);
  // The wall was not there for the agent itself.
  EXPECT_NEAR(lengthOn(test::previewIn(returnsAt({}), {4.0, 0.0}, agent_)), 3.6, 1e-9);
  const Decision& decision = test::decideIn(returnsAt({}, {0.4, 0.0, 0.0}), &agent_);
  EXPECT_NEAR(lengthOn(decision), 4.0 - 0.8, 1e-9);
}

TEST_F(NavigationRoutes, ANewGoalKeepsWhatWasSeenAndARestartForgetsIt) {
  test::decideIn(returnsAt(kWall), &agent_);
  agent_.setGoal({4.0, 0.0});
  EXPECT_GT(lengthOn(test::decideIn(returnsAt({}), &agent_)) + 0.4, kRoundTheWall);
  agent_.restart();
  EXPECT_NEAR(lengthOn(test::decideIn(returnsAt({}), &agent_)), 3.6, 1e-9);
}

TEST_F(NavigationRoutes, WithoutMemoryThereIsNoPathOn) {
  AgentParameters forgetful;
  forgetful.memory.enabled = false;
  NavigationAgent agent(stubbornPolicy(), forgetful);
  agent.setGoal({4.0, 0.0});
  const Decision& decision = test::decideIn(returnsAt(kWall, {0.0, 0.0, 0.3}), &agent);
  EXPECT_TRUE(decision.path_on.empty());
  EXPECT_FALSE(decision.on_route);
  EXPECT_NEAR(decision.direction, 0.3, 1e-12);
}

TEST_F(NavigationRoutes, ARobotThatIsHeldUpOnTheRouteIsLedAnotherWay) {
  ASSERT_NEAR(test::decideIn(situationAt({}), &agent_).direction, 0.0, 1e-9);
  const Decision& decision = test::decideIn(situationAt({}, 2.1), &agent_);
  EXPECT_EQ(decision.choice, Leader::kRoute);
  ASSERT_TRUE(decision.on_route);
  // Round a place 0.3 m ahead: at less than the footprint from it there is no path.
  EXPECT_GT(std::abs(decision.direction), 0.3);
  EXPECT_GT(distanceBetween(decision.waypoint, Point2{0.3, 0.0}), 0.15);
}

TEST_F(NavigationRoutes, ARobotThatIsHeldByAnEmergencyStopLearnsNothingAboutThePlace) {
  const Decision before = test::decideIn(returnsAt(kWall), &agent_);
  const Point2 ahead = pointAlong(Point2{}, before.direction, 0.3);
  const auto isFree = [&] { return agent_.memory()->isFree(Point2{}, ahead, Passage::kTight); };
  int blocked = 0;
  for (int i = 1; i <= 600; ++i) {
    Situation held = returnsAt({});
    held.time = 0.5 * i;
    EXPECT_EQ(test::decideIn(held, &agent_).choice, Leader::kRoute) << held.time << " s";
    blocked += !isFree();
  }
  EXPECT_EQ(blocked, 4) << "for 2 s it is led another way";
  EXPECT_TRUE(isFree());
  EXPECT_GT(lengthOn(agent_.decision()) + 0.4, kRoundTheWall) << "the wall is remembered";
  // Set free, it drives on: if it is held up elsewhere, it is led another way again.
  Situation on = returnsAt({}, {ahead.x, ahead.y, before.direction});
  on.time = 301.0;
  test::decideIn(on, &agent_);
  on.time = 303.0;
  test::decideIn(on, &agent_);
  EXPECT_GT(std::abs(normalizeAngle(agent_.decision().direction - before.direction)), 0.3);
}

TEST_F(NavigationRoutes, ARobotThatIsHeldByHandLearnsNothingAboutThePlaceAhead) {
  const Decision before = test::decideIn(returnsAt({}), &agent_);
  const Point2 ahead = pointAlong(Point2{}, before.direction, 0.3);
  const auto isFree = [&] { return agent_.memory()->isFree(ahead, ahead, Passage::kTight); };
  Situation held = returnsAt({});
  held.time = 2.0;
  test::decideIn(held, &agent_);
  EXPECT_FALSE(isFree());
  // A hand on the robot: the other way is not free either, and a third one is taken.
  Situation touched = returnsAt({pointAlong(Point2{}, agent_.decision().direction, 0.1)});
  touched.time = 3.0;
  test::decideIn(touched, &agent_);
  EXPECT_FALSE(isFree());
  held.time = 4.0;
  test::decideIn(held, &agent_);
  EXPECT_TRUE(isFree());
}

TEST_F(NavigationRoutes, SaysThatThereIsNoPathAfterThreeTurnsInAClosedRing) {
  double turned = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Decision& decision = test::decideIn(situationAt({0.0, 0.0, turned}, 0.5 * i, test::ring(0.8)), &agent_);
    if (decision.choice == Move::kNoPath) break;
    ASSERT_EQ(decision.choice, Move::kLookAround) << i;
    turned += 0.5;
  }
  EXPECT_EQ(agent_.decision().choice, Move::kNoPath);
  EXPECT_GT(turned, 3.0 * (2.0 * M_PI - 0.5));
  EXPECT_LT(turned, 3.0 * (2.0 * M_PI + 0.5) + 1.0);
  // It stays with that until there is a new goal.
  EXPECT_EQ(test::decideIn(situationAt({}, 99.0), &agent_).choice, Move::kNoPath);
  agent_.setGoal({0.3, 0.3});
  EXPECT_NE(test::decideIn(situationAt({}, 99.1, test::ring(0.8)), &agent_).choice, Move::kNoPath);
}

TEST_F(NavigationRoutes, BoundariesAreFollowedAtTheLastResort) {
  AgentParameters parameters = test::routeLed();
  parameters.escape.patience_steps = 3;
  parameters.escape.last_resort = 2.0;
  NavigationAgent agent(stubbornPolicy(), parameters);
  agent.setGoal({4.0, 0.0});
  // It goes to and fro without coming nearer.
  for (int step = 0; step <= 6; ++step) {
    const Decision::Choice choice =
        test::decideIn(situationAt({step % 2 == 0 ? 0.0 : -0.5, 0.0, 0.0}, step), &agent).choice;
    EXPECT_EQ(choice, step < 6 ? Leader::kRoute : Leader::kEscape) << step;
  }
}

}  // namespace
}  // namespace lstm_planner::test_navigation_routes
