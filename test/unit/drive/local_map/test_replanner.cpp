#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lstm_planner/drive/local_map/replanner.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_replanner {
namespace {

using Answer = Replanner::Answer;
using test::returnsAt;
using test::seenFrom;

/// A room of 4 x 4 m around (2, 2) in the middle of a hall of 12 x 4 m.
OccupancyGrid closedRoom() {
  OccupancyGrid grid = test::emptyHall(12.0, 4.0);
  test::fillBox(4.0, 0.0, 4.1, 4.0, &grid);
  return grid;
}

class ReplannerTest : public test::GuideFixture {
 protected:
  /// Turns the robot on the spot by 40 degrees a time while it is told to look around, at most `turns` times round.
  Answer lookAround(const World& world, Pose2* pose, double turns) {
    Answer status = update(seenFrom(world, *pose));
    turned_ = 0.0;
    while (status == Answer::kLookAround && turned_ < 2.0 * M_PI * turns) {
      pose->yaw += degreesToRadians(40.0);
      turned_ += degreesToRadians(40.0);
      status = update(seenFrom(world, *pose));
    }
    return status;
  }

  /// Whether the path goes round the upper end of a wall that lies across it.
  bool goesAbove() const {
    double highest = -1e9;
    double lowest = 1e9;
    for (const Point2& point : guide_.route().points) {
      highest = std::max(highest, point.y);
      lowest = std::min(lowest, point.y);
    }
    return highest > -lowest;
  }

  /// A turn on the spot where nothing is seen; the answer in the end.
  Answer turn(Pose2 pose = {}) {
    Answer status = Answer::kLookAround;
    for (int i = 0; i < 10; ++i) {
      pose.yaw += degreesToRadians(40.0);
      status = update(returnsAt({}, pose));
    }
    return status;
  }

  /// Beams from one direction to another that see that far; all others know nothing.
  static RangeProfile seeing(float range, double from, double to) {
    RangeProfile profile;
    profile.first_direction = -M_PI;
    profile.increment = 0.01;
    profile.ranges.assign(629, 0.0f);
    for (std::size_t beam = 0; beam < profile.ranges.size(); ++beam) {
      if (profile.direction(beam) >= from && profile.direction(beam) <= to) profile.ranges[beam] = range;
    }
    return profile;
  }

  double turned_ = 0.0;  ///< rad
};

TEST_F(ReplannerTest, LeadsFromTheRobotToTheGoal) {
  start({5.0, 3.0});
  ASSERT_EQ(update(returnsAt({}, {1.0, 0.0, 0.0})), Answer::kRoute);
  EXPECT_EQ(guide_.route().points.front().x, 1.0);
  EXPECT_EQ(guide_.end().x, 5.0);
  EXPECT_DOUBLE_EQ(guide_.route().length, 5.0);
  EXPECT_NEAR(guide_.pointAhead(2.5).x, 3.0, 1e-12);
  EXPECT_NEAR(guide_.pointAhead(2.5).y, 1.5, 1e-12);
  EXPECT_EQ(guide_.pointAhead(7.0).x, 5.0);
}

TEST_F(ReplannerTest, KnowsTheCornersAhead) {
  start({4.0, 0.0});
  ASSERT_EQ(update(returnsAt(test::wall({2.0, -1.0}, {2.0, 3.0}))), Answer::kRoute);
  const std::vector<Point2>& points = guide_.route().points;
  ASSERT_GE(points.size(), 3u);
  std::vector<Point2> ahead;
  guide_.pointsAhead(0.4, &ahead);
  ASSERT_EQ(ahead.size(), points.size() - 1);
  EXPECT_EQ(ahead.front().x, points[1].x);
  EXPECT_EQ(ahead.back().x, 4.0);
  guide_.pointsAhead(distanceBetween(points[0], points[1]) + 0.01, &ahead);
  EXPECT_EQ(ahead.size(), points.size() - 2);
  guide_.pointsAhead(100.0, &ahead);
  EXPECT_TRUE(ahead.empty());
}

TEST_F(ReplannerTest, BelievesThatARoomIsClosedAfterThreeLooksAroundAndNotEarlier) {
  const GridWorld world(closedRoom());
  start({8.0, 2.0});
  Pose2 pose{2.0, 2.0, 0.0};
  // What lies behind the robot at first is unknown, and a path leads there.
  for (double yaw = 0.0; yaw < 3.2; yaw += 0.8) update(seenFrom(world, {2.0, 2.0, yaw}));
  EXPECT_EQ(lookAround(world, &pose, 8.0), Answer::kNoPath);
  // Three full turns, each less what the scanner sees more than its heading, and more by what it turns at once.
  EXPECT_GT(turned_, 3.0 * (2.0 * M_PI - 0.5) - degreesToRadians(160.0));
  EXPECT_LT(turned_, 3.0 * 2.0 * M_PI + degreesToRadians(160.0));
}

TEST_F(ReplannerTest, FindsTheDoorThatWasOpenedWhileItLookedAround) {
  const GridWorld closed(closedRoom());
  OccupancyGrid grid = closedRoom();
  for (int row = 30; row < 60; ++row) {
    for (int column = 79; column < 83; ++column) grid.set({column, row}, Cell::kFree);
  }
  const GridWorld open(grid);
  start({8.0, 2.0});
  Pose2 pose{2.0, 2.0, 0.0};
  for (double yaw = 0.0; yaw < 3.2; yaw += 0.8) update(seenFrom(closed, {2.0, 2.0, yaw}));
  ASSERT_EQ(lookAround(closed, &pose, 1.5), Answer::kLookAround);
  EXPECT_EQ(lookAround(open, &pose, 1.5), Answer::kRoute);
}

TEST_F(ReplannerTest, OneWrongObstacleDoesNotCloseARoom) {
  OccupancyGrid grid = closedRoom();
  for (int row = 30; row < 60; ++row) {
    for (int column = 79; column < 83; ++column) grid.set({column, row}, Cell::kFree);
  }
  const GridWorld world(grid);
  start({8.0, 2.0});
  for (double yaw = 0.0; yaw < 3.2; yaw += 0.8) update(seenFrom(world, {2.0, 2.0, yaw}));
  // Somebody stood in the door, and is no longer there when it is looked at anew.
  Situation person = seenFrom(world, {2.0, 2.0, 0.0});
  for (const Point2& point : test::wall({2.1, -0.6}, {2.1, 1.1})) person.obstacles.push_back(point);
  person.profile.ranges.clear();
  EXPECT_EQ(update(person), Answer::kLookAround);
  Pose2 pose{2.0, 2.0, 0.0};
  EXPECT_EQ(lookAround(world, &pose, 8.0), Answer::kRoute);
  EXPECT_LT(turned_, 2.0 * M_PI + 0.1);
}

TEST_F(ReplannerTest, ARobotThatCannotTurnAroundSearchesWithWhatItSees) {
  start({-4.0, 0.0});
  ASSERT_EQ(update(returnsAt(test::ring(0.8))), Answer::kLookAround);
  Situation ahead = returnsAt(test::wall({1.0, -1.0}, {1.0, 1.0}));
  ahead.time = 1.0;
  ASSERT_EQ(update(ahead), Answer::kLookAround) << "it may be about to turn";
  guide_.forget();
  ahead.time = 6.0;
  EXPECT_EQ(update(ahead), Answer::kRoute);
}

TEST_F(ReplannerTest, IsLostWhenTheMemoryWasWrongAgainAndAgainWithoutProgress) {
  const std::vector<Point2> around = test::ring(0.8);
  start({8.0, 0.0});
  // Each time it is enclosed all around, looks around, and sees something else.
  for (int time = 0; time < 4; ++time) {
    ASSERT_EQ(update(returnsAt(around)), Answer::kLookAround) << time;
    guide_.forget();
    ASSERT_EQ(turn(), Answer::kRoute) << time;
  }
  EXPECT_EQ(update(returnsAt(around)), Answer::kLost);
}

TEST_F(ReplannerTest, AMetreOfProgressForgivesWhatWentWrong) {
  const std::vector<Point2> around = test::ring(0.8);
  start({8.0, 0.0});
  for (int time = 0; time < 20; ++time) {
    ASSERT_EQ(update(returnsAt(around)), Answer::kLookAround) << time;
    guide_.forget();
    ASSERT_EQ(turn(), Answer::kRoute) << time;
    guide_.noteProgress({time - 30.0, 0.0}, {});
  }
}

TEST_F(ReplannerTest, ALittleProgressForgivesNothing) {
  const std::vector<Point2> around = test::ring(0.8);
  start({8.0, 0.0});
  guide_.noteProgress({-8.0, 0.0}, {});
  for (int time = 0; time < 4; ++time) {
    ASSERT_EQ(update(returnsAt(around)), Answer::kLookAround) << time;
    guide_.forget();
    ASSERT_EQ(turn(), Answer::kRoute) << time;
    guide_.noteProgress({-7.7 + 0.2 * time, 0.0}, {});
  }
  EXPECT_EQ(update(returnsAt(around)), Answer::kLost);
}

TEST_F(ReplannerTest, ProgressIsThatToTheGoalWhereItLiesNow) {
  const std::vector<Point2> around = test::ring(0.8);
  const auto answerAfter = [&](const Point2& goal) {
    start({8.0, 0.0});
    guide_.noteProgress({}, {8.0, 0.0});
    for (int time = 0; time < 4; ++time) {
      EXPECT_EQ(update(returnsAt(around)), Answer::kLookAround) << time;
      guide_.forget();
      EXPECT_EQ(turn(), Answer::kRoute) << time;
    }
    guide_.noteProgress({1.0, 0.0}, goal);
    const Answer answer = update(returnsAt(around));
    guide_.forget();
    return answer;
  };
  EXPECT_EQ(answerAfter({10.0, 0.0}), Answer::kLookAround) << "it lies farther away now, and the robot came a metre";
  EXPECT_EQ(answerAfter({0.5, 0.0}), Answer::kLost) << "it lies nearer now, and the robot came no nearer";
}

TEST_F(ReplannerTest, ANewGoalIsFoundThroughWhatWasSeenBefore) {
  start({-4.0, 0.0});
  update(returnsAt(test::wall({2.0, -1.0}, {2.0, 3.0})));
  start({4.0, 0.0});
  ASSERT_EQ(update(returnsAt({})), Answer::kRoute);
  EXPECT_GT(guide_.route().length, 2.0 * std::sqrt(5.0));
  guide_.forget();
  ASSERT_EQ(update(returnsAt({})), Answer::kRoute);
  EXPECT_DOUBLE_EQ(guide_.route().length, 4.0);
}

TEST_F(ReplannerTest, DoesNotTurnBackForAPathThatIsHardlyBetter) {
  start({4.0, 0.0});
  update(returnsAt(test::wall({2.0, -2.2}, {2.0, 1.5})));
  ASSERT_TRUE(goesAbove());
  // The lower metre of the wall is gone: below it is shorter by 2 * (hypot(2, 1.8) - hypot(2, 1.5)) = 0.38 m.
  Situation cleared = returnsAt({});
  cleared.profile = seeing(20.0f, std::atan2(-2.4, 2.0), std::atan2(-1.2, 2.0));
  update(cleared);
  EXPECT_TRUE(goesAbove());
  // Who had no path yet takes that one.
  start({4.0, 0.0});
  update(returnsAt({}));
  EXPECT_FALSE(goesAbove());
}

TEST_F(ReplannerTest, TakesAMuchBetterPathAndLeavesOneThatIsBlocked) {
  start({4.0, 0.0});
  update(returnsAt(test::wall({2.0, -3.0}, {2.0, 1.0})));
  ASSERT_TRUE(goesAbove());
  // It goes on above: there the wall is 4 m long.
  update(returnsAt(test::wall({2.0, 1.0}, {2.0, 4.0})));
  EXPECT_FALSE(goesAbove());
  // Clear from end to end: straight on.
  Situation nothing = returnsAt({});
  nothing.profile = seeing(20.0f, -M_PI, M_PI);
  update(nothing);
  EXPECT_DOUBLE_EQ(guide_.route().length, 4.0);
}

TEST_F(ReplannerTest, KeepsItsPathToAGoalThatMovesALittle) {
  const Situation wall = returnsAt(test::wall({2.0, -1.1}, {2.0, 1.0}));
  const Point2 moved{4.0, -0.2};
  start({4.0, 0.0});
  ASSERT_EQ(update(wall), Answer::kRoute);
  ASSERT_TRUE(goesAbove());
  moveGoal(moved);
  EXPECT_EQ(guide_.end().y, moved.y);
  EXPECT_DOUBLE_EQ(guide_.route().length, lengthOf(guide_.route().points));
  ASSERT_EQ(update(wall), Answer::kRoute);
  EXPECT_TRUE(goesAbove());
  EXPECT_EQ(guide_.end().y, moved.y);
  // Who sets out for it anew goes below, where it is nearer now.
  start(moved);
  ASSERT_EQ(update(wall), Answer::kRoute);
  EXPECT_FALSE(goesAbove());
}

TEST_F(ReplannerTest, ARobotOfAnySizeKeepsItsOwnPlaceFreeWhereItIsBlockedAhead) {
  for (const double radius : {0.2, 0.4, 0.6, 1.0}) {
    AgentParameters parameters;
    parameters.shield.footprint_radius = radius;
    parameters.memory.resolution = std::max(parameters.memory.resolution, 0.1 * (radius + parameters.memory.comfort));
    validate(parameters);
    Replanner guide(parameters.memory, parameters.shield);
    guide.start();
    const Situation here = returnsAt({});
    ASSERT_EQ(guide.update(here, {6.0, 0.0}, 0.15), Answer::kRoute);
    guide.blockAhead();
    EXPECT_EQ(guide.update(here, {6.0, 0.0}, 0.15), Answer::kRoute) << radius;
    EXPECT_GT(guide.route().length, 6.05) << radius;
  }
}

TEST_F(ReplannerTest, ANewGoalTakesBackWhatWasOnlyTakenAsBlocked) {
  const Situation here = returnsAt({});
  for (int goal = 0; goal < 2; ++goal) {
    start({4.0, 0.0});
    ASSERT_EQ(update(here), Answer::kRoute);
    EXPECT_NEAR(guide_.route().length, 4.0, 0.01);
    guide_.blockAhead();
    ASSERT_EQ(update(here), Answer::kRoute);
    EXPECT_GT(guide_.route().length, 4.05);
  }
}

TEST_F(ReplannerTest, BlockedAheadItLeadsAnotherWay) {
  start({4.0, 0.0});
  const Situation here = returnsAt({});
  ASSERT_EQ(update(here), Answer::kRoute);
  guide_.blockAhead();
  ASSERT_EQ(update(here), Answer::kRoute);
  // Round a place 0.3 m ahead, at the footprint's distance at least.
  EXPECT_GT(guide_.route().length, 4.05);
  double nearest = 1.0;
  for (double ahead = 0.0; ahead < 1.0; ahead += 0.01) {
    nearest = std::min(nearest, distanceBetween(guide_.pointAhead(ahead), Point2{0.3, 0.0}));
  }
  const AgentParameters parameters;
  EXPECT_GT(nearest, parameters.shield.footprint_radius - parameters.memory.resolution);
}

TEST_F(ReplannerTest, LeadsTheRobotToTheGoalOnNoLongerWayThanItSaidAtFirst) {
  const std::vector<Point2> wall = test::wall({2.0, -1.0}, {2.0, 3.0});
  start({4.0, 0.0});
  update(returnsAt(wall));
  const double whole = guide_.route().length;
  double driven = 0.0;
  Pose2 pose;
  while (distanceBetween(pose, Point2{4.0, 0.0}) > 0.1 && driven < 2.0 * whole) {
    const Point2 next = guide_.pointAhead(0.1);
    driven += distanceBetween(pose, next);
    pose = {next.x, next.y, directionTo(pose, next)};
    ASSERT_EQ(update(returnsAt(wall, pose)), Answer::kRoute);
  }
  EXPECT_LT(driven, whole + 0.1);
}

TEST_F(ReplannerTest, EndsBesideAGoalInAnObstacleIfTheToleranceAllowsIt) {
  // The goal lies in the middle of a pillar: 0.3 + 0.174 m from where the robot can be.
  const double beside = 0.3 + AgentParameters().shield.footprint_radius;
  std::vector<Point2> pillar;
  for (const double radius : {0.3, 0.15}) {
    for (const Point2& point : test::ring(radius)) pillar.push_back({8.0 + point.x, point.y});
  }
  const Situation seen = returnsAt(pillar, {4.0, 0.0, 0.0});
  start({8.0, 0.0});
  tolerance_ = beside;
  EXPECT_EQ(update(seen), Answer::kLookAround) << "the tight clearance is missing";
  tolerance_ = beside + 0.15;
  start({8.0, 0.0});
  ASSERT_EQ(update(seen), Answer::kRoute);
  EXPECT_LE(distanceBetween(guide_.end(), Point2{8.0, 0.0}), tolerance_);
}

TEST_F(ReplannerTest, TheRegretOfAStepIsHowMuchLongerThePathThroughItsEndIs) {
  const Point2 goal{4.0, 0.0};
  start(goal);
  ASSERT_EQ(update(returnsAt({})), Answer::kRoute);
  // A path from cell to cell is up to 8 % longer than the straight line; both ends of the difference are.
  const double rounding = 0.08 * 0.4 + guide_.memory().cellSize();
  std::vector<Point2> path_on;
  EXPECT_NEAR(guide_.regretOf({}, {0.4, 0.0}, &path_on), 0.0, rounding);
  EXPECT_NEAR(guide_.regretOf({}, {0.0, 0.4}, &path_on), 0.4, rounding);
  EXPECT_NEAR(guide_.regretOf({}, {-0.4, 0.0}, &path_on), 0.8, rounding);
  ASSERT_FALSE(path_on.empty());
  EXPECT_EQ(distanceBetween(path_on.back(), goal), 0.0);
  EXPECT_EQ(guide_.route().points.size(), 2u) << "asking changes nothing";
}

TEST_F(ReplannerTest, AStepIntoAClosedPlaceIsRegrettedWithoutEnd) {
  start({4.0, 0.0});
  std::vector<Point2> ring;
  for (const Point2& point : test::ring(0.6)) ring.push_back({-2.0 + point.x, point.y});
  ASSERT_EQ(update(returnsAt(ring)), Answer::kRoute);
  std::vector<Point2> path_on;
  EXPECT_EQ(guide_.regretOf({}, {-2.0, 0.0}, &path_on), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(path_on.empty());
}

}  // namespace
}  // namespace lstm_planner::test_replanner
