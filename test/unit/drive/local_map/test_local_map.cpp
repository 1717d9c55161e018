#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/perception/reach.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"
#include "unit/drive/perception/scan_builder.hpp"

namespace lstm_planner::test_local_map {
namespace {

using Passage = LocalMap::Passage;
using test::returnsAt;
using test::seenFrom;

const AgentParameters kDefaults;
const double kRadius = kDefaults.shield.footprint_radius;
const double kResolution = kDefaults.memory.resolution;

/// Middle of the square that a place lies in.
Point2 squareOf(const Point2& place) {
  return {(std::floor(place.x / kResolution) + 0.5) * kResolution,
          (std::floor(place.y / kResolution) + 0.5) * kResolution};
}

LocalMap emptyMemory(double width = 20.0) {
  MemoryParameters parameters = kDefaults.memory;
  parameters.width = width;
  return LocalMap(parameters, kDefaults.shield);
}

/// Whether the robot cannot stand there, as far as is remembered.
bool isBlocked(LocalMap* memory, const Point2& place) { return !memory->isFree(place, place, Passage::kTight); }

TEST(LocalMap, TakesAllThatWasNeverSeenForFree) {
  LocalMap memory = emptyMemory();
  memory.add(test::situationAt({}));
  EXPECT_EQ(memory.passage(memory.cellAt({3.0, -4.0})), Passage::kRoomy);
  EXPECT_EQ(memory.exits(memory.cellAt({3.0, -4.0})), 0xff);
}

TEST(LocalMap, RemembersAWallAfterTurningAwayFromIt) {
  OccupancyGrid grid = test::emptyHall(8.0, 8.0);
  test::fillBox(5.0, 3.0, 5.1, 5.0, &grid);
  const GridWorld world(grid);
  LocalMap memory = emptyMemory();
  memory.add(seenFrom(world, {4.0, 4.0, 0.0}));
  EXPECT_TRUE(isBlocked(&memory, {5.05, 4.0}));
  memory.add(seenFrom(world, {4.0, 4.0, M_PI}));
  EXPECT_TRUE(isBlocked(&memory, {5.05, 4.0}));
}

TEST(LocalMap, ForgetsWhatTheScanShowsClear) {
  OccupancyGrid with_box = test::emptyHall(8.0, 8.0);
  test::fillBox(5.0, 3.7, 5.3, 4.3, &with_box);
  LocalMap memory = emptyMemory();
  memory.add(seenFrom(GridWorld(with_box), {4.0, 4.0, 0.0}));
  ASSERT_TRUE(isBlocked(&memory, {5.05, 4.0}));
  memory.add(seenFrom(GridWorld(test::emptyHall(8.0, 8.0)), {4.0, 4.0, 0.0}));
  EXPECT_EQ(memory.passage(memory.cellAt({5.05, 4.0})), Passage::kRoomy);
}

TEST(LocalMap, KeepsWhatIsFartherThanTheScannerCanSee) {
  OccupancyGrid with_box = test::emptyHall(12.0, 8.0);
  test::fillBox(8.0, 3.7, 8.3, 4.3, &with_box);
  LocalMap memory = emptyMemory();
  memory.add(seenFrom(GridWorld(with_box), {6.0, 4.0, 0.0}));
  ASSERT_TRUE(isBlocked(&memory, {8.05, 4.0}));
  // From farther away: no beam returns, which says nothing of what is beyond 3.5 m (an LDS-01).
  Situation open = seenFrom(GridWorld(test::emptyHall(12.0, 8.0)), {4.0, 4.0, 0.0});
  std::fill(open.profile.ranges.begin(), open.profile.ranges.end(), std::numeric_limits<float>::infinity());
  open.obstacles.clear();
  open.profile.farthest_range = 3.5;
  memory.add(open);
  EXPECT_TRUE(isBlocked(&memory, {8.05, 4.0}));
  open.profile.farthest_range = 30.0;
  memory.add(open);
  EXPECT_FALSE(isBlocked(&memory, {8.05, 4.0}));
}

TEST(LocalMap, KeepsWhatIsHiddenWhenTheScanEndsBeforeIt) {
  OccupancyGrid grid = test::emptyHall(8.0, 8.0);
  test::fillBox(6.0, 3.7, 6.1, 4.3, &grid);
  LocalMap memory = emptyMemory();
  memory.add(seenFrom(GridWorld(grid), {4.0, 4.0, 0.0}));
  OccupancyGrid hidden = test::emptyHall(8.0, 8.0);
  test::fillBox(5.0, 3.0, 5.1, 5.0, &hidden);  // somebody stands in between
  memory.add(seenFrom(GridWorld(hidden), {4.0, 4.0, 0.0}));
  EXPECT_TRUE(isBlocked(&memory, {6.05, 4.0}));
}

TEST(LocalMap, KeepsAWallThatBeamsGraze) {
  // The robot drives along a wall 0.25 m beside it: far ahead neighbouring beams end metres apart.
  const OccupancyGrid grid = test::emptyHall(12.0, 6.0);
  const GridWorld world(grid);
  LocalMap memory = emptyMemory(30.0);
  for (double x = 1.0; x < 8.0; x += 0.07) {
    memory.add(seenFrom(world, {x, 0.35, 0.02 * std::sin(20.0 * x)}));
  }
  for (double x = 1.2; x < 10.0; x += 0.1) {
    EXPECT_FALSE(memory.isFree({x, 0.35}, {x, -0.3}, Passage::kTight)) << "at " << x;
  }
}

TEST(LocalMap, DoesNotForgetWhereTheScanKnowsNothing) {
  const GridWorld world(test::emptyHall(8.0, 8.0));
  LocalMap memory = emptyMemory();
  memory.add(seenFrom(world, {4.0, 4.0, 0.0}));
  Situation lost = seenFrom(GridWorld(test::emptyHall(40.0, 40.0)), {4.0, 4.0, 0.0});
  lost.obstacles.clear();
  std::fill(lost.profile.ranges.begin(), lost.profile.ranges.end(), 0.0f);
  memory.add(lost);
  EXPECT_TRUE(isBlocked(&memory, {7.95, 4.0}));
}

TEST(LocalMap, DoesNotForgetWhereAFilterTookBeamsOut) {
  LocalMap memory = emptyMemory();
  memory.add(returnsAt({{1.0, 0.0}}));
  const auto showEverywhere = [&](float reading) {
    Situation situation;
    perceive(makeHokuyoScan(reading), {}, urgNodeRules(), 6.0, &situation);
    memory.add(situation);
  };
  showEverywhere(61.0f);  // range_max + 1, as laser_filters and ira_laser_tools send it
  EXPECT_TRUE(isBlocked(&memory, {1.0, 0.0}));
  showEverywhere(std::numeric_limits<float>::infinity());
  EXPECT_FALSE(isBlocked(&memory, {1.0, 0.0}));
}

TEST(LocalMap, CarriesWhatIsNearAlongWithTheRobot) {
  LocalMap memory = emptyMemory(10.0);
  const Point2 post{1.0, 0.6};
  memory.add(returnsAt({post}));
  const int cells = memory.side() * memory.side();
  for (double x = 0.0; x < 5.0; x += 0.3) {
    memory.add(returnsAt({}, {x, 0.0, 0.0}));
    // Half the window less the eighth that the robot may be off its middle, less a cell: 3.5 m all around are inside.
    ASSERT_GE(memory.cellAt({x - 3.5, 0.0}), 0);
    ASSERT_GE(memory.cellAt({x + 3.5, 0.0}), 0);
    if (x <= 4.5) {
      EXPECT_TRUE(isBlocked(&memory, post)) << "robot at " << x;
      EXPECT_FALSE(isBlocked(&memory, {post.x, post.y + 0.6})) << "robot at " << x;
    }
  }
  for (double x = 5.0; x < 30.0; x += 0.5) memory.add(returnsAt({}, {x, 0.0, 0.0}));
  EXPECT_LT(memory.cellAt(post), 0);
  for (double x = 30.0; x > 0.0; x -= 0.5) memory.add(returnsAt({}, {x, 0.0, 0.0}));
  EXPECT_FALSE(isBlocked(&memory, post));  // what left the window is forgotten
  EXPECT_EQ(memory.side() * memory.side(), cells);
}

TEST(LocalMap, RemembersWhatIsKnownBeforehandAlsoFarAwayAndAfterForgetting) {
  LocalMap memory = emptyMemory(10.0);
  const Point2 near{1.0, 0.6};
  const Point2 far{30.0, 0.6};
  memory.know({near, far});
  memory.add(returnsAt({}));
  EXPECT_TRUE(isBlocked(&memory, near)) << "though it was never seen";
  memory.add(returnsAt({}, {29.0, 0.0, 0.0}));
  EXPECT_TRUE(isBlocked(&memory, far)) << "where the window comes later";
  memory.forget();
  memory.add(returnsAt({}));
  EXPECT_TRUE(isBlocked(&memory, near));
  EXPECT_FALSE(isBlocked(&memory, {near.x, near.y + 0.6}));
  memory.know({});
  memory.forget();
  memory.add(returnsAt({}));
  EXPECT_FALSE(isBlocked(&memory, near));
}

TEST(LocalMap, StartsAnewWhereTheRobotJumpsTo) {
  LocalMap memory = emptyMemory(10.0);
  memory.add(returnsAt({{1.0, 0.0}}));
  memory.add(returnsAt({{-998.0, 500.0}}, {-1000.0, 500.0, 1.0}));
  EXPECT_TRUE(isBlocked(&memory, {-998.0, 500.0}));
  EXPECT_LT(memory.cellAt({1.0, 0.0}), 0);
}

/// The best passage across a corridor along y between two walls, `free` squares apart, at all alignments with the
/// cells.
TEST(LocalMap, TellsPassagesApartByTheirWidth) {
  MemoryParameters parameters = kDefaults.memory;
  parameters.width = 10.0;
  parameters.comfort = 0.17;
  const double tight = kRadius + 0.5 * kDefaults.shield.tight_clearance;
  const double narrow = kRadius + kDefaults.shield.clearance + 0.5 * kResolution;
  const double roomy = kRadius + parameters.comfort;
  bool seen[4] = {};
  for (int free = 3; free < 20; ++free) {
    // The square in the middle is this far from the nearer wall's.
    const double gap = (free + 1) / 2 * kResolution;
    const Passage expected = gap < tight    ? Passage::kBlocked
                             : gap < narrow ? Passage::kTight
                             : gap < roomy  ? Passage::kNarrow
                                            : Passage::kRoomy;
    seen[static_cast<int>(expected)] = true;
    for (int shift = 0; shift < 4; ++shift) {
      LocalMap memory(parameters, kDefaults.shield);
      const double left = 1.0 + (shift + 0.5) * kResolution;
      const double right = left + (free + 1) * kResolution;
      std::vector<Point2> walls = test::wall({left, -2.0}, {left, 2.0});
      for (const Point2& point : test::wall({right, -2.0}, {right, 2.0})) walls.push_back(point);
      memory.add(returnsAt(walls));
      // The cells of the walls themselves reach to their other side.
      Passage inside = Passage::kBlocked;
      for (int cell = memory.cellAt({left, 0.5}); cell <= memory.cellAt({right, 0.5}); ++cell) {
        const Point2 place = memory.bestPlace(cell);
        if (place.x > left && place.x < right) inside = std::max(inside, memory.passage(cell));
      }
      EXPECT_EQ(static_cast<int>(inside), static_cast<int>(expected)) << free << " squares, shift " << shift;
    }
  }
  EXPECT_TRUE(seen[0] && seen[1] && seen[2] && seen[3]);
}

TEST(LocalMap, LetsNoRobotThroughAGapThatItDoesNotFitInto) {
  // Two walls d squares apart are more than d - 1 and less than d + 1 squares of free space apart. A robot of 0.3485 m
  // asks for a square 3.8 squares from both: 8 squares. So what is below 7 squares = 0.35 m is never a passage, and
  // what is above 8 squares plus one = 0.45 m always is, however the walls lie on the squares.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0.0, 0.2);
  for (int i = 0; i < 200; ++i) {
    const double left = 1.0 + anywhere(random);
    for (const double width : {0.349, 0.451}) {
      LocalMap memory = emptyMemory(10.0);
      std::vector<Point2> walls = test::wall({left, -1.0}, {left, 1.0});
      for (const Point2& point : test::wall({left + width, -1.0}, {left + width, 1.0})) walls.push_back(point);
      memory.add(returnsAt(walls));
      bool passable = true;
      for (double y = -0.9; y <= 0.9 && passable; y += memory.cellSize()) {
        bool row = false;
        for (double x = left; x <= left + width; x += 0.05) {
          const int cell = memory.cellAt({x, y});
          const Point2 place = memory.bestPlace(cell);
          row = row || (memory.passage(cell) != Passage::kBlocked && place.x > left && place.x < left + width);
        }
        passable = row;
      }
      ASSERT_EQ(passable, width > 0.4) << "wall at " << left << ", gap " << width;
    }
  }
}

/// Posts, walls at any angle and dust, so near to one another that many places are just wide enough.
std::vector<Point2> randomObstacles(std::mt19937* random) {
  std::uniform_real_distribution<double> place(-1.6, 1.6);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * M_PI);
  std::uniform_real_distribution<double> length(0.05, 1.5);
  std::vector<Point2> places;
  for (int i = 0; i < 7; ++i) {
    const Point2 begin{place(*random), place(*random)};
    for (const Point2& point : test::wall(begin, pointAlong(begin, angle(*random), length(*random)))) {
      places.push_back(point);
    }
    places.push_back({place(*random), place(*random)});
  }
  return places;
}

double nearest(const std::vector<Point2>& squares, const Point2& from, const Point2& to) {
  double nearest = std::numeric_limits<double>::infinity();
  const double length = std::max(distanceBetween(from, to), 1e-12);
  const Point2 along{(to.x - from.x) / length, (to.y - from.y) / length};
  for (const Point2& square : squares) {
    const double at =
        std::clamp((square.x - from.x) * along.x + (square.y - from.y) * along.y, 0.0, distanceBetween(from, to));
    nearest = std::min(nearest, distanceBetween(square, Point2{from.x + at * along.x, from.y + at * along.y}));
  }
  return nearest;
}

TEST(LocalMap, JudgesPlacesAndExitsAsBruteForceOnTheSquaresDoes) {
  constexpr int kColumns[] = {1, 1, 0, -1, -1, -1, 0, 1};
  constexpr int kRows[] = {0, 1, 1, 1, 0, -1, -1, -1};
  const double tight = kRadius + 0.5 * kDefaults.shield.tight_clearance;
  const double narrow = kRadius + kDefaults.shield.clearance + 0.5 * kResolution;
  const double roomy = kRadius + kDefaults.memory.comfort;
  const double hair = 1e-9;
  std::mt19937 random(4);
  int exits = 0;
  int walls = 0;
  for (int round = 0; round < 20; ++round) {
    LocalMap memory = emptyMemory(10.0);
    const std::vector<Point2> places = randomObstacles(&random);
    memory.add(returnsAt(places, {2.9, 2.9, 1.0}));
    std::vector<Point2> squares;
    for (const Point2& place : places) {
      const Point2 square = squareOf(place);
      if (squares.empty() || distanceBetween(squares.back(), square) > 0.5 * kResolution) squares.push_back(square);
    }
    for (double y = -1.9; y < 2.0; y += 0.2) {
      for (double x = -1.9; x < 2.0; x += 0.2) {
        const int cell = memory.cellAt({x, y});
        const double room = nearest(squares, memory.bestPlace(cell), memory.bestPlace(cell));
        for (int square = 0; square < 16; ++square) {  // none is better than the best
          const Point2 other{x - 0.075 + square % 4 * kResolution, y - 0.075 + square / 4 * kResolution};
          ASSERT_EQ(memory.cellAt(other), cell);
          ASSERT_LE(std::min(nearest(squares, other, other), roomy), room + hair);
        }
        const Passage expected = room < tight    ? Passage::kBlocked
                                 : room < narrow ? Passage::kTight
                                 : room < roomy  ? Passage::kNarrow
                                                 : Passage::kRoomy;
        ASSERT_EQ(static_cast<int>(memory.passage(cell)), static_cast<int>(expected)) << x << " " << y;
        for (int direction = 0; direction < 8; ++direction) {
          const int to = cell + kRows[direction] * memory.side() + kColumns[direction];
          const double gap = nearest(squares, memory.bestPlace(cell), memory.bestPlace(to));
          const bool free = memory.passage(cell) != Passage::kBlocked && memory.passage(to) != Passage::kBlocked &&
                            gap >= tight - 0.5 * kResolution;
          const bool sure = std::abs(gap - (tight - 0.5 * kResolution)) > hair;
          ASSERT_TRUE(!sure || free == ((memory.exits(cell) >> direction & 1) != 0))
              << "round " << round << " at " << x << " " << y << " direction " << direction << " gap " << gap;
          exits += free ? 1 : 0;
          walls += !free && memory.passage(cell) != Passage::kBlocked && memory.passage(to) != Passage::kBlocked;
        }
      }
    }
  }
  EXPECT_GT(exits, 5000);
  EXPECT_GT(walls, 20);  // what stands between two places that are both free
}

TEST(LocalMap, LeadsThroughNoWallHoweverThinAndAtWhateverAngle) {
  // Everything that can be walked to from one side of a wall across the whole window lies on that side.
  for (double degrees = 0.0; degrees < 180.0; degrees += 7.3) {
    MemoryParameters parameters = kDefaults.memory;
    parameters.width = 4.0;
    LocalMap memory(parameters, kDefaults.shield);
    const double angle = degreesToRadians(degrees);
    const Point2 middle{0.013 * degrees / 10.0, 0.031};
    const Pose2 robot{middle.x - 0.8 * std::sin(angle), middle.y + 0.8 * std::cos(angle), 0.0};
    // A return every 7 cm: what 1/4 degree is wide at 12 m, seen at an angle of 48 degrees.
    std::vector<Point2> wall;
    for (double along = -4.0; along <= 4.0; along += 0.07) wall.push_back(pointAlong(middle, angle, along));
    memory.add(returnsAt(wall, robot));
    std::vector<char> reached(static_cast<std::size_t>(memory.side() * memory.side()));
    std::vector<int> open = {memory.cellAt({robot.x, robot.y})};
    reached[static_cast<std::size_t>(open.front())] = 1;
    constexpr int kColumns[] = {1, 1, 0, -1, -1, -1, 0, 1};
    constexpr int kRows[] = {0, 1, 1, 1, 0, -1, -1, -1};
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      const Point2 place = memory.bestPlace(cell);
      const double side = -(place.x - middle.x) * std::sin(angle) + (place.y - middle.y) * std::cos(angle);
      ASSERT_GT(side, 0.0) << degrees << " degrees";
      for (int direction = 0; direction < 8; ++direction) {
        const int to = cell + kRows[direction] * memory.side() + kColumns[direction];
        if ((memory.exits(cell) >> direction & 1) != 0 && !reached[static_cast<std::size_t>(to)]) {
          reached[static_cast<std::size_t>(to)] = 1;
          open.push_back(to);
        }
      }
    }
  }
}

TEST(LocalMap, SqueezesThroughWhatIsNarrowByTheBlurOfTheSquaresOnly) {
  LocalMap memory = emptyMemory(10.0);
  // Seven squares from wall to wall: the middle ones are 3 and 4 squares off, 0.15 m from the nearer wall.
  std::vector<Point2> walls = test::wall({1.025, -2.0}, {1.025, 2.0});
  for (const Point2& point : test::wall({1.375, -2.0}, {1.375, 2.0})) walls.push_back(point);
  memory.add(returnsAt(walls));
  const Point2 from{1.175, -1.0};
  const Point2 to{1.175, 1.0};
  EXPECT_FALSE(memory.isFree(from, to, Passage::kTight));
  memory.relaxClearance(true);  // asks for 0.174 m less half a square: 0.149 m
  EXPECT_TRUE(memory.isFree(from, to, Passage::kTight));
  EXPECT_FALSE(isBlocked(&memory, {1.175, 0.0}));
  memory.relaxClearance(false);
  EXPECT_FALSE(memory.isFree(from, to, Passage::kTight));
}

TEST(LocalMap, ABlockedPlaceStaysBlockedThoughTheScanShowsItClear) {
  const GridWorld world(test::emptyHall(8.0, 8.0));
  LocalMap memory = emptyMemory();
  memory.add(seenFrom(world, {4.0, 4.0, 0.0}));
  const Point2 place{5.0, 4.0};
  ASSERT_FALSE(isBlocked(&memory, place));
  memory.block(place);
  memory.add(seenFrom(world, {4.1, 4.0, 0.0}));
  EXPECT_FALSE(memory.isFree({4.5, 4.0}, {5.5, 4.0}, Passage::kTight));
  EXPECT_TRUE(memory.isFree({4.5, 4.4}, {5.5, 4.4}, Passage::kRoomy));
  memory.forget();
  memory.add(seenFrom(world, {4.1, 4.0, 0.0}));
  EXPECT_TRUE(memory.isFree({4.5, 4.0}, {5.5, 4.0}, Passage::kRoomy));
}

TEST(LocalMap, ABlockIsTakenBackAndTheOthersStay) {
  LocalMap memory = emptyMemory();
  memory.add(test::situationAt({}));
  memory.unblock({2.0, 0.0});  // it is not blocked
  memory.block({2.0, 0.0});
  memory.block({1.0, 0.0});
  ASSERT_TRUE(isBlocked(&memory, {2.0, 0.0}));
  memory.unblock({2.0, 0.0});
  EXPECT_FALSE(isBlocked(&memory, {2.0, 0.0}));
  EXPECT_EQ(memory.passage(memory.cellAt({2.0, 0.0})), Passage::kRoomy);
  EXPECT_TRUE(isBlocked(&memory, {1.0, 0.0}));
}

TEST(LocalMap, ThirtyTwoBlockedPlacesAreKeptTheOldestIsForgotten) {
  LocalMap memory = emptyMemory(40.0);
  memory.add(test::situationAt({}));
  for (int i = 0; i <= 32; ++i) memory.block({-15.0 + 0.9 * i, 2.05});
  EXPECT_TRUE(memory.isFree({-15.0, 1.5}, {-15.0, 2.5}, Passage::kRoomy));
  for (int i = 1; i <= 32; ++i) {
    EXPECT_FALSE(memory.isFree({-15.0 + 0.9 * i, 1.5}, {-15.0 + 0.9 * i, 2.5}, Passage::kTight)) << i;
  }
}

TEST(LocalMap, TakesThePlaceWhereTheRobotStandsForFree) {
  LocalMap memory = emptyMemory();
  memory.add(returnsAt({{2.0, 0.0}}));
  ASSERT_TRUE(isBlocked(&memory, {2.0, 0.0}));
  memory.add(returnsAt({{2.02, 0.03}}, {2.0, 0.05, 0.0}));  // odometry drifted, or the scanner sees the robot itself
  EXPECT_EQ(memory.passage(memory.cellAt({2.0, 0.05})), Passage::kRoomy);
}

TEST(LocalMap, IgnoresAPoseThatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  LocalMap memory = emptyMemory();
  memory.add(returnsAt({{1.0, 0.0}}));
  for (const Pose2& pose : {Pose2{nan, 0.0, 0.0}, Pose2{0.0, infinity, 0.0}, Pose2{0.0, 0.0, nan}}) {
    Situation situation = test::situationAt(pose, 0.0, {{0.5, 0.0}});
    memory.add(situation);
  }
  EXPECT_TRUE(isBlocked(&memory, {1.0, 0.0}));
  EXPECT_FALSE(isBlocked(&memory, {0.45, 0.0}));
  EXPECT_GE(memory.cellAt({0.0, 0.0}), 0);
}

TEST(LocalMap, StaysWhereItIsWhenThePoseIsOutOfReach) {
  LocalMap memory = emptyMemory();
  memory.add(returnsAt({{1.0, 0.0}}));
  for (const Pose2& pose : {Pose2{1.2e8, 0.0, 0.0}, Pose2{0.0, -1e12, 0.0}, Pose2{1e300, 1e300, 0.0}}) {
    memory.add(test::situationAt(pose, 0.0, {{0.5, 0.0}}));
    EXPECT_EQ(memory.cellAt({pose.x, pose.y}), -1);
    EXPECT_FALSE(memory.isFree({pose.x, pose.y}, {pose.x, pose.y}, Passage::kTight));
  }
  EXPECT_TRUE(isBlocked(&memory, {1.0, 0.0}));
  EXPECT_EQ(memory.cellAt({std::nan(""), 0.0}), -1);
}

TEST(LocalMap, RemembersAmongTheFarthestPosesAsAtTheOrigin) {
  for (const Point2& corner : {Point2{kFarthestPose, kFarthestPose}, Point2{-kFarthestPose, kFarthestPose}}) {
    LocalMap memory = emptyMemory();
    memory.add(test::situationAt({corner.x, corner.y, M_PI_2}, 0.0, {{1.0, 0.0}}));
    EXPECT_TRUE(isBlocked(&memory, {corner.x, corner.y + 1.0}));
    EXPECT_FALSE(isBlocked(&memory, {corner.x + 1.0, corner.y}));
  }
}

TEST(LocalMap, TakesNoNoticeOfReturnsThatAreTooFarForWholeNumbers) {
  LocalMap memory = emptyMemory();
  memory.add(test::situationAt({}, 0.0, {{1e9, 0.0}, {1.0, 0.0}, {-1e30, 1e30}, {0.0, -1e38}}));
  EXPECT_TRUE(isBlocked(&memory, {1.0, 0.0}));
  for (int cell = 0; cell < memory.side() * memory.side(); ++cell) {
    const Point2 center = memory.centerOf(cell);
    if (std::hypot(center.x - 1.0, center.y) > 0.6) {
      ASSERT_EQ(memory.passage(cell), Passage::kRoomy) << center.x << ", " << center.y;
    }
  }
}

TEST(LocalMap, DoesNotRememberWhatIsFartherThanItsReach) {
  LocalMap memory = emptyMemory(40.0);
  memory.add(returnsAt({{11.9, 0.0}, {0.0, 12.1}}));
  EXPECT_TRUE(isBlocked(&memory, {11.9, 0.0}));
  EXPECT_FALSE(isBlocked(&memory, {0.0, 12.1}));
}

}  // namespace
}  // namespace lstm_planner::test_local_map
