#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <random>
#include <vector>

#include "lstm_planner/drive/local_map/replanner.hpp"
#include "lstm_planner/grid/cell_queue.hpp"
#include "support/case_name.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_kept_route {
namespace {

using Answer = Replanner::Answer;
using test::returnsAt;

const AgentParameters kDefaults;

/// Sees these places, and through everything else that is nearer than 20 m.
Situation seeingThrough(double from, double to, const Pose2& pose) {
  Situation situation = returnsAt({}, pose);
  situation.profile.first_direction = -M_PI;
  situation.profile.increment = 0.01;
  situation.profile.ranges.assign(629, 0.0f);
  for (std::size_t beam = 0; beam < situation.profile.ranges.size(); ++beam) {
    const double direction = situation.profile.direction(beam);
    if (direction >= from && direction <= to) situation.profile.ranges[beam] = 20.0f;
  }
  return situation;
}

class KeptRouteTest : public test::GuideFixture {
 protected:
  KeptRouteTest() {
    start({6.0, 0.0});
    EXPECT_EQ(update(returnsAt(wall_)), Answer::kRoute);
  }

  double highest() const {
    double highest = -1e9;
    for (const Point2& point : guide_.route().points) highest = std::max(highest, point.y);
    return highest;
  }

  void expectPassable(Replanner* guide) {
    const std::vector<Point2>& points = guide->route().points;
    ASSERT_GT(points.size(), 2u) << "round something";
    for (std::size_t i = 2; i < points.size(); ++i) {
      EXPECT_TRUE(guide->isPassable(points[i - 1], points[i])) << "piece " << i;
    }
  }

  /// Below it the path is shorter.
  const std::vector<Point2> wall_ = test::wall({3.0, -2.0}, {3.0, 4.0});
};

TEST_F(KeptRouteTest, BeginsWhereTheRobotIs) {
  Pose2 pose;
  while (distanceBetween(pose, Point2{6.0, 0.0}) > 0.3) {
    const Point2 next = guide_.pointAhead(0.2);
    pose = {next.x, next.y, directionTo(pose, next)};
    ASSERT_EQ(update(returnsAt(wall_, pose)), Answer::kRoute);
    ASSERT_EQ(guide_.route().points.front().x, pose.x);
    ASSERT_EQ(guide_.route().length, lengthOf(guide_.route().points));
  }
}

TEST_F(KeptRouteTest, CutsCornersThatTheFirstHad) {
  const Point2 goal{-25.0, 5.0};
  start(goal);
  Pose2 pose;
  double driven = 0.0;
  while (distanceBetween(pose, goal) > 0.3) {
    ASSERT_EQ(update(returnsAt({}, pose)), Answer::kRoute);
    const Point2 next = guide_.pointAhead(0.2);
    driven += distanceBetween(pose, next);
    pose = {next.x, next.y, directionTo(pose, next)};
  }
  // A search leads along cells, in eight directions, and pulls straight the first 8 m only.
  EXPECT_LT(driven, 1.02 * distanceBetween(Point2{}, goal));
}

TEST_F(KeptRouteTest, StaysWhenAnObstacleAppearsElsewhere) {
  const std::vector<Point2> before = guide_.route().points;
  std::vector<Point2> places = wall_;
  for (const Point2& point : test::wall({1.0, 2.0}, {2.0, 2.0})) places.push_back(point);
  ASSERT_EQ(update(returnsAt(places)), Answer::kRoute);
  ASSERT_EQ(guide_.route().points.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(distanceBetween(guide_.route().points[i], before[i]), 0.0);
  }
}

TEST_F(KeptRouteTest, IsLeftWhenAnObstacleLiesOnIt) {
  const Point2 middle = guide_.pointAhead(0.5 * guide_.route().length);
  std::vector<Point2> places = wall_;
  for (const Point2& point : test::wall({middle.x, middle.y - 1.0}, {middle.x, middle.y + 1.0})) {
    places.push_back(point);
  }
  ASSERT_EQ(update(returnsAt(places)), Answer::kRoute);
  expectPassable(&guide_);
}

TEST_F(KeptRouteTest, IsLeftWhenAShortcutOpens) {
  // A door of 1.2 m where the straight path leads through the wall.
  const double aside = std::atan2(0.6, 3.0);
  ASSERT_EQ(update(seeingThrough(-aside, aside, {})), Answer::kRoute);
  EXPECT_LT(guide_.route().length, 6.1);
}

TEST_F(KeptRouteTest, IsLeftWhenTheRobotIsPushedOff) {
  ASSERT_LT(highest(), 1.0);
  // Near the upper end of the wall the path round that end is much shorter than back to the lower one.
  ASSERT_EQ(update(returnsAt(wall_, {2.4, 4.2, 0.0})), Answer::kRoute);
  EXPECT_GT(highest(), 4.0);
}

TEST_F(KeptRouteTest, IsLeftWhenItIsBlockedBehindADoorPost) {
  // From here no straight line leads into the door, so that what the path costs is not known.
  const Pose2 pose{0.24, 0.16, 0.0};
  const Point2 goal{6.0, 0.0};
  std::vector<Point2> places;
  for (const double side : {-1.0, 1.0}) {
    for (const Point2& point : test::wall({0.42, side * 0.22}, {0.42, side * 3.0})) places.push_back(point);
  }
  Replanner guide(kDefaults.memory, kDefaults.shield);
  guide.start();
  ASSERT_EQ(guide.update(returnsAt(places, pose), goal, kDefaults.goal_tolerance), Answer::kRoute);
  for (const Point2& point : test::wall({3.0, -1.0}, {3.0, 1.0})) places.push_back(point);
  ASSERT_EQ(guide.update(returnsAt(places, pose), goal, kDefaults.goal_tolerance), Answer::kRoute);
  expectPassable(&guide);
}

TEST_F(KeptRouteTest, EndsAtAGoalThatMovesALittle) {
  moveGoal({6.01, 0.01});
  ASSERT_EQ(update(returnsAt(wall_)), Answer::kRoute);
  EXPECT_EQ(guide_.end().x, 6.01);
}

/// A robot that sees walls come and go keeps its path, but for the share that is worth turning for.
class KeptRouteAmongWalls : public ::testing::TestWithParam<unsigned> {};

TEST_P(KeptRouteAmongWalls, KeepsNoRouteThatASearchFindsMuchBetter) {
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> place(-6.0, 6.0);
  std::uniform_real_distribution<double> direction(-M_PI, M_PI);
  std::uniform_real_distribution<double> length(0.5, 2.5);
  Replanner keeping(kDefaults.memory, kDefaults.shield);
  Replanner searching(kDefaults.memory, kDefaults.shield);
  LocalMap memory(kDefaults.memory, kDefaults.shield);
  const RouteFinder finder(kDefaults.memory.tightness);
  const Point2 goal{8.0, 0.0};
  Pose2 pose{-8.0, 0.0, 0.0};
  keeping.start();
  int compared = 0;
  for (int step = 0; step < 80 && distanceBetween(pose, goal) > 0.5; ++step) {
    const double from = direction(random);
    Situation situation = seeingThrough(from, from + 0.15, pose);
    if (step % 3 == 0) {
      const Point2 begin{place(random), place(random)};
      const Point2 end = pointAlong(begin, direction(random), length(random));
      for (const Point2& point : test::wall(begin, end)) {
        if (distanceBetween(point, pose) > 0.8 && distanceBetween(point, goal) > 0.8) {
          situation.obstacles.push_back(toLocalFrame(pose, point));
        }
      }
    }
    memory.add(situation);
    searching.start();  // knows no route: searches
    const Answer kept = keeping.update(situation, goal, kDefaults.goal_tolerance);
    if (searching.update(situation, goal, kDefaults.goal_tolerance) != Answer::kRoute) break;
    ASSERT_EQ(kept, Answer::kRoute) << "step " << step;
    const double cost = test::costOf(keeping.route(), finder, &memory);
    const double least = test::costOf(searching.route(), finder, &memory);
    ASSERT_LE(cost, 1.08 * least + 0.3 + 1e-9) << "8 % and 0.3 m are not worth turning for; step " << step;
    ++compared;
    const Point2 next = keeping.pointAhead(0.3);
    pose = {next.x, next.y, directionTo(pose, next)};
  }
  EXPECT_GT(compared, 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, KeptRouteAmongWalls, ::testing::Range(1u, 9u), test::caseName("Seed"));

TEST(CellQueue, GivesEstimatesInOrder) {
  std::mt19937 random(3);
  CellQueue queue;
  std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> expected;
  queue.clear(100);
  std::uint32_t lowest = 100;
  int given = 0;
  for (int i = 0; i < 20000; ++i) {
    if (i < 12000) {
      // Mostly a little more than the lowest, as a search's; some far beyond the buckets.
      const std::uint32_t estimate = lowest + random() % (i % 50 == 0 ? 5000 : 29);
      queue.push(estimate, static_cast<std::uint16_t>(estimate), 7);
      expected.push(estimate);
    }
    if (i % 3 != 0) {
      ASSERT_EQ(queue.lowest(&lowest), !expected.empty());
      if (expected.empty()) continue;
      ASSERT_EQ(lowest, expected.top());
      std::uint16_t column = 0;
      std::uint16_t row = 0;
      queue.pop(&column, &row);
      ASSERT_EQ(column, static_cast<std::uint16_t>(lowest));
      expected.pop();
      ++given;
    }
  }
  EXPECT_EQ(given, 12000);
}

}  // namespace
}  // namespace lstm_planner::test_kept_route
