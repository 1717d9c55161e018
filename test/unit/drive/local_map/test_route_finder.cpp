#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <random>
#include <utility>
#include <vector>

#include "lstm_planner/drive/local_map/route_finder.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_route_finder {
namespace {

using Passage = LocalMap::Passage;
using test::returnsAt;

const AgentParameters kDefaults;
const double kRadius = kDefaults.shield.footprint_radius;
const double kTightness = kDefaults.memory.tightness;
const double kTolerance = kDefaults.goal_tolerance;

void append(const std::vector<Point2>& more, std::vector<Point2>* places) {
  places->insert(places->end(), more.begin(), more.end());
}

/// The four sides of a rectangle.
std::vector<Point2> box(const Point2& low, const Point2& high) {
  std::vector<Point2> places = test::wall(low, {high.x, low.y});
  append(test::wall({high.x, low.y}, high), &places);
  append(test::wall(high, {low.x, high.y}), &places);
  append(test::wall({low.x, high.y}, low), &places);
  return places;
}

class RouteFinderTest : public ::testing::Test {
 protected:
  RouteFinderTest() : memory_(parameters(), kDefaults.shield), finder_(kTightness) {}

  static MemoryParameters parameters() {
    MemoryParameters parameters;
    parameters.width = 20.0;
    return parameters;
  }

  /// Puts the robot somewhere, where it sees these places of the odometry frame.
  void remember(const std::vector<Point2>& places, const Pose2& robot = {}) {
    places_ = places;
    memory_.add(returnsAt(places, robot));
  }

  bool find(const Point2& start, const Point2& goal, double tolerance = kTolerance) {
    return finder_.find(memory_, start, goal, tolerance, &route_);
  }

  /// The nearest that the route comes to anything, m.
  double clearance() const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < route_.points.size(); ++i) {
      const Point2& from = route_.points[i - 1];
      const Point2& to = route_.points[i];
      const int parts = 1 + static_cast<int>(distanceBetween(from, to) / 0.01);
      for (int part = 0; part <= parts; ++part) {
        const double share = static_cast<double>(part) / parts;
        const Point2 at{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
        for (const Point2& place : places_) nearest = std::min(nearest, distanceBetween(at, place));
      }
    }
    return nearest;
  }

  double lengthOfPoints() const {
    double length = 0.0;
    for (std::size_t i = 1; i < route_.points.size(); ++i) {
      length += distanceBetween(route_.points[i - 1], route_.points[i]);
    }
    return length;
  }

  LocalMap memory_;
  RouteFinder finder_;
  Route route_;
  std::vector<Point2> places_;
};

/// What the squares may take from a clearance: half a square's diagonal, and half a square for paths between squares.
const double kBlur = (0.5 * std::sqrt(2.0) + 0.5) * kDefaults.memory.resolution;

TEST_F(RouteFinderTest, GoesStraightWhereNothingIsKnown) {
  remember({});
  ASSERT_TRUE(find({0.03, 0.07}, {4.31, 2.57}));
  ASSERT_EQ(route_.points.size(), 2u);
  EXPECT_EQ(route_.points[0].x, 0.03);
  EXPECT_EQ(route_.points[1].y, 2.57);
  EXPECT_DOUBLE_EQ(route_.length, std::hypot(4.28, 2.5));
  // Along cells it is at most 8 % longer (octile), its diagonals 1 % cheaper.
  EXPECT_GT(route_.cost, 0.99 * (route_.length - 0.3));
  EXPECT_LT(route_.cost, 1.08 * (route_.length + 0.3));
}

TEST_F(RouteFinderTest, GoesTowardsTheGoalHoweverFarItIs) {
  remember({});
  for (const double distance : {100.0, 9.2e3, 9.27e3, 9.5e3, 1e4, 1e6, 1e9, 1e12, 1e30}) {
    const Point2 goal{0.8 * distance, -0.6 * distance};
    ASSERT_TRUE(find({0.1, 0.1}, goal)) << distance;
    const Point2& out = route_.points.at(route_.points.size() - 2);
    EXPECT_GT(out.x, 5.0) << distance;
    EXPECT_NEAR(route_.length, distance, 0.03 * distance) << distance;
  }
}

TEST(RouteFinder, FindsAPathOfThreeKilometresInsideItsWindow) {
  // 43 corridors of 1.6 m, joined at alternate ends.
  MemoryParameters parameters = kDefaults.memory;
  parameters.reach = 60.0;
  constexpr double kHalf = 34.4;
  constexpr double kWidth = 1.6;
  constexpr int kCorridors = 43;
  std::vector<Point2> places;
  const auto wall = [&](double from, double to, double y) {
    for (double x = from; x <= to; x += 0.04) places.push_back({x, y});
  };
  for (int i = 0; i <= kCorridors; ++i) {
    const bool outside = i == 0 || i == kCorridors;
    wall(outside || i % 2 == 0 ? -kHalf : -kHalf + kWidth, outside || i % 2 != 0 ? kHalf : kHalf - kWidth,
         -kHalf + i * kWidth);
  }
  for (double y = -kHalf; y <= kHalf; y += 0.04) append({{-kHalf, y}, {kHalf, y}}, &places);
  LocalMap memory(parameters, kDefaults.shield);
  memory.add(returnsAt(places));

  RouteFinder finder(kTightness);
  Route route;
  const Point2 start{kHalf - 0.8, -kHalf + 0.8};
  const Point2 goal{-kHalf + 0.8, kHalf - 0.8};
  ASSERT_TRUE(finder.find(memory, start, goal, kTolerance, &route));
  EXPECT_NEAR(route.length, kCorridors * (2.0 * kHalf - kWidth), 60.0);
  EXPECT_GT(route.cost / memory.cellSize() * kStraightFifths, 70000.0) << "more than 16 bits tell";
  // The rest of it by the same search, and a short path after it.
  const double length = route.length;
  const Point2 farther{0.0, -kHalf + 0.8};
  ASSERT_TRUE(finder.findFrom(memory, farther, &route));
  EXPECT_NEAR(route.length, length - distanceBetween(start, farther), 1.0);
  ASSERT_TRUE(finder.find(memory, start, farther, kTolerance, &route));
  EXPECT_NEAR(route.length, distanceBetween(start, farther), 0.1);
  // What is walled off is told as ever.
  append(test::wall({0.0, -kHalf}, {0.0, kHalf}), &places);
  memory.add(returnsAt(places));
  EXPECT_FALSE(finder.find(memory, start, goal, kTolerance, &route));
}

TEST_F(RouteFinderTest, GoesRoundAWallOnAPathNearlyAsShortAsATautString) {
  remember(test::wall({2.0, -1.0}, {2.0, 3.0}));
  const Point2 goal{4.0, 0.0};
  ASSERT_TRUE(find({0.0, 0.0}, goal));
  // A string round the lower end of the wall, and round a disc of the comfortable clearance there: two tangents of
  // sqrt(5 - r^2) and the arc between them.
  const double disc = kRadius + kDefaults.memory.comfort;
  const double to_end = std::sqrt(5.0);
  const double tangent = std::sqrt(5.0 - disc * disc);
  const double arc = disc * (M_PI - 2.0 * std::atan2(2.0, 1.0) + 2.0 * std::asin(disc / to_end));
  EXPECT_GT(route_.length, 2.0 * to_end);
  // A corner may lie a cell's diagonal off the string: as much more on both sides, in part.
  EXPECT_LT(route_.length, 2.0 * tangent + arc + memory_.cellSize() * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(route_.length, lengthOfPoints());
  EXPECT_GT(clearance(), disc - kBlur);
}

TEST_F(RouteFinderTest, TakesThePathRoundTheOtherEndWhenThatIsShorter) {
  remember(test::wall({2.0, -3.0}, {2.0, 1.0}));
  ASSERT_TRUE(find({0.0, 0.0}, {4.0, 0.0}));
  const auto highest = std::max_element(route_.points.begin(), route_.points.end(),
                                        [](const Point2& a, const Point2& b) { return a.y < b.y; });
  EXPECT_GT(highest->y, 1.0 + kRadius);
  EXPECT_LT(route_.length, 2.0 * std::sqrt(5.0) + 1.0);
}

TEST_F(RouteFinderTest, FindsNoneWhenTheStartIsEnclosed) {
  remember(box({-1.0, -1.0}, {1.0, 1.0}));
  EXPECT_FALSE(find({0.0, 0.0}, {4.0, 0.0}));
  EXPECT_FALSE(find({0.0, 0.0}, {400.0, 0.0}));
}

TEST_F(RouteFinderTest, FindsNoneWhenTheGoalIsEnclosed) {
  remember(box({3.0, -1.0}, {5.0, 1.0}));
  EXPECT_FALSE(find({0.0, 0.0}, {4.0, 0.0}));
  EXPECT_TRUE(find({3.5, 0.5}, {4.0, 0.0}));  // from inside there is one
}

TEST_F(RouteFinderTest, FindsNoneFromOutsideTheWindow) {
  remember({});
  EXPECT_FALSE(find({30.0, 0.0}, {4.0, 0.0}));
}

TEST_F(RouteFinderTest, LeadsToAGoalOutsideTheWindowBeyondItStraight) {
  remember(test::wall({2.0, -2.0}, {2.0, 1.0}));
  const Point2 goal{50.0, 0.0};
  ASSERT_TRUE(find({0.0, 0.0}, goal));
  EXPECT_EQ(route_.points.back().x, goal.x);
  EXPECT_EQ(route_.points.back().y, goal.y);
  // Round the upper end of the wall. At the border of the window it may be aside by what costs the steps on the cells
  // nothing; there the rest is taken as straight.
  const double taut = std::hypot(2.0, 1.0 + kRadius) + std::hypot(48.0, 1.0 + kRadius);
  EXPECT_GT(route_.length, taut - 0.2);
  EXPECT_LT(route_.length, 1.02 * taut);
  EXPECT_GT(clearance(), kRadius + kDefaults.memory.comfort - kBlur);
}

TEST_F(RouteFinderTest, ReplacesAGoalThatLiesInSomethingByTheNearestPlaceWithinTheTolerance) {
  // A pillar of 0.3 m; in its middle the robot would need to be 0.15 + 0.174 m away.
  remember(box({3.9, -0.1}, {4.2, 0.2}));
  const Point2 goal{4.05, 0.05};
  EXPECT_FALSE(find({0.0, 0.0}, goal, 0.15));
  ASSERT_TRUE(find({0.0, 0.0}, goal, 0.6));
  const double beside = distanceBetween(route_.points.back(), goal);
  EXPECT_GT(beside, 0.15 + kRadius - kBlur);
  // The nearest place that fits lies in a cell of 0.2 m, at most its diagonal farther than the clearance asks for.
  EXPECT_LT(beside, 0.15 + kRadius + 0.5 * kDefaults.shield.tight_clearance + std::sqrt(2.0) * memory_.cellSize());
  EXPECT_GT(clearance(), kRadius - kBlur);
}

TEST_F(RouteFinderTest, EndsWhereTheFootprintFitsHoweverNearToAWallTheGoalIs) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(0.0, 0.2);
  int moved = 0;
  for (int i = 0; i < 200; ++i) {
    const double wall = 3.0 + shift(random);
    memory_.forget();
    remember(test::wall({wall, -3.0}, {wall, 3.0}));
    const Point2 goal{wall - 1.5 * shift(random), shift(random)};
    ASSERT_TRUE(find({0.0, 0.0}, goal, 0.35));
    // So near to the wall the nearest place may be behind it.
    ASSERT_GT(std::abs(wall - route_.points.back().x), kRadius - kBlur)
        << "goal " << wall - goal.x << " m from the wall";
    ASSERT_LE(distanceBetween(route_.points.back(), goal), 0.35);
    moved += distanceBetween(route_.points.back(), goal) > 0.0;
  }
  EXPECT_GT(moved, 50);
}

TEST_F(RouteFinderTest, FindsTheNearestPlaceBesideAWallWhereverItLiesOnTheSquares) {
  // The fourth square from the wall's is the first that is free: 0.2 m from its middle, at most 0.225 m from the wall.
  // That is no more than 0.105 m from the goal, and half a square aside.
  std::mt19937 random(6);
  std::uniform_real_distribution<double> shift(0.0, 0.2);
  for (int i = 0; i < 100; ++i) {
    const double wall = 3.0 + shift(random);
    memory_.forget();
    remember(test::wall({wall, -3.0}, {wall, 3.0}));
    const Point2 goal{wall - 0.12, shift(random)};
    ASSERT_TRUE(find({0.0, 0.0}, goal, 0.15)) << "wall at " << wall;
    ASSERT_LT(route_.points.back().x, wall);
    ASSERT_LE(distanceBetween(route_.points.back(), goal), std::hypot(0.105, 0.025) + 1e-9);
  }
}

TEST_F(RouteFinderTest, SettlesForAPlaceBeforeAThinWallRatherThanALongDetour) {
  // The goal lies 0.25 m behind a wall that is 8 m longer on both sides; the start is near it already.
  remember(test::wall({1.0, -8.0}, {1.0, 8.0}));
  const Point2 goal{1.25, 0.0};
  const Point2 start{0.72, 0.0};
  ASSERT_TRUE(find(start, goal, 0.6));
  EXPECT_LT(route_.length, 0.6);
  EXPECT_LE(distanceBetween(route_.points.back(), goal), 0.6);
  EXPECT_LT(route_.points.back().x, 1.0);
  // From far away, or with less tolerance, it is gone to.
  ASSERT_TRUE(find(start, goal, 0.3));
  EXPECT_GT(route_.length, 2.0 * 8.0);
  EXPECT_EQ(route_.points.back().x, goal.x);
  ASSERT_TRUE(find({-2.0, 0.0}, goal, 0.6));
  EXPECT_EQ(route_.points.back().x, goal.x);
}

TEST_F(RouteFinderTest, MakesAShortDetourThoughItIsNearEnough) {
  remember(test::wall({1.0, -8.0}, {1.0, 0.3}));
  ASSERT_TRUE(find({0.72, 0.0}, {1.25, 0.0}, 0.6));
  EXPECT_EQ(route_.points.back().x, 1.25);
  EXPECT_LT(route_.length, 3.0 * 0.6);
}

TEST_F(RouteFinderTest, PrefersAWideDoorALittleFartherToATightOne) {
  // A wall with a door of 0.45 m straight ahead, and one of 1.2 m at y = `aside`.
  const auto pathThrough = [&](double aside) {
    memory_.forget();
    std::vector<Point2> places = test::wall({2.025, -9.0}, {2.025, -0.225});
    append(test::wall({2.025, 0.225}, {2.025, aside - 0.6}), &places);
    append(test::wall({2.025, aside + 0.6}, {2.025, 9.0}), &places);
    // The tight door is a passage of 0.6 m: three times its length is 1.2 m more.
    append(test::wall({2.025, -0.225}, {2.625, -0.225}), &places);
    append(test::wall({2.025, 0.225}, {2.625, 0.225}), &places);
    remember(places);
    EXPECT_TRUE(find({0.0, 0.0}, {4.4, 0.0}));
    double highest = 0.0;
    for (const Point2& point : route_.points) highest = std::max(highest, point.y);
    return highest;
  };
  // Through the wide one it is about hypot(2, 1) + hypot(2.4, 1) - 4.4 = 0.44 m farther.
  EXPECT_GT(pathThrough(1.3), 0.7);
  // And here about 2 * (hypot(2.2, 4.4) - 2.2) = 5.4 m.
  EXPECT_LT(pathThrough(5.0), 0.2);
}

TEST_F(RouteFinderTest, CostsARouteUnderWhatIsRememberedNow) {
  remember({});
  ASSERT_TRUE(find({0.0, 0.0}, {4.0, 0.0}));
  EXPECT_DOUBLE_EQ(test::costOf(route_, finder_, &memory_), 4.0);
  memory_.add(returnsAt(test::wall({2.0, -1.0}, {2.0, 1.0})));
  EXPECT_EQ(test::costOf(route_, finder_, &memory_), std::numeric_limits<double>::infinity());
  memory_.forget();
  // Walls on both sides, 0.25 m from the path: tight, and it is one piece.
  std::vector<Point2> places = test::wall({1.0, 0.225}, {3.0, 0.225});
  append(test::wall({1.0, -0.225}, {3.0, -0.225}), &places);
  remember(places);
  EXPECT_DOUBLE_EQ(test::costOf(route_, finder_, &memory_), kTightness * 4.0);
}

/// Least cost between two cells by plain Dijkstra with exact factors, in metres; +inf when there is no path.
double dijkstra(LocalMap* memory, int start, int goal) {
  constexpr int kColumns[] = {1, 1, 0, -1, -1, -1, 0, 1};
  constexpr int kRows[] = {0, 1, 1, 1, 0, -1, -1, -1};
  const double factors[] = {kTightness, kTightness, 1.0 + 0.25 * (kTightness - 1.0), 1.0};
  std::vector<double> costs(static_cast<std::size_t>(memory->side() * memory->side()),
                            std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  open.push({0.0, start});
  costs[static_cast<std::size_t>(start)] = 0.0;
  while (!open.empty()) {
    const auto [cost, cell] = open.top();
    open.pop();
    if (cell == goal) return cost;
    if (cost > costs[static_cast<std::size_t>(cell)]) continue;
    for (int direction = 0; direction < 8; ++direction) {
      if ((memory->exits(cell) >> direction & 1) == 0) continue;
      const int to = cell + kRows[direction] * memory->side() + kColumns[direction];
      const double step = memory->cellSize() * (direction % 2 != 0 ? 1.4 : 1.0);
      const double sum = cost + step * factors[static_cast<int>(memory->passage(to))];
      if (sum < costs[static_cast<std::size_t>(to)]) {
        costs[static_cast<std::size_t>(to)] = sum;
        open.push({sum, to});
      }
    }
  }
  return std::numeric_limits<double>::infinity();
}

TEST_F(RouteFinderTest, CostsAsMuchAsDijkstraFindsInRandomMemories) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-6.0, 6.0);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * M_PI);
  std::uniform_real_distribution<double> length(0.1, 4.0);
  int paths = 0;
  int walls = 0;
  for (int round = 0; round < 60; ++round) {
    memory_.forget();
    std::vector<Point2> places;
    for (int i = 0; i < 45; ++i) {
      const Point2 begin{place(random), place(random)};
      append(test::wall(begin, pointAlong(begin, angle(random), length(random))), &places);
    }
    remember(places, {0.3 * place(random), 0.3 * place(random), 0.0});
    for (int query = 0; query < 4; ++query) {
      const Point2 start{place(random), place(random)};
      const Point2 goal{place(random), place(random)};
      const int from = memory_.cellAt(start);
      const int to = memory_.cellAt(goal);
      if (memory_.passage(to) == Passage::kBlocked) continue;
      const double expected = dijkstra(&memory_, from, to);
      const bool found = find(start, memory_.bestPlace(to), 1e-9);
      ASSERT_EQ(found, std::isfinite(expected)) << "round " << round << " query " << query;
      if (!found) {
        ++walls;
        continue;
      }
      ++paths;
      // Diagonal steps through narrow places are rounded down from 10.5 tenths to 10, straight ones from 7.5 to 7.
      ASSERT_LE(route_.cost, expected + 1e-6);
      ASSERT_GE(route_.cost, expected * 7.0 / 7.5 - 1e-6);
      ASSERT_DOUBLE_EQ(route_.length, lengthOfPoints());
      ASSERT_EQ(route_.points.front().x, start.x);
      ASSERT_LT(distanceBetween(route_.points.back(), goal), memory_.cellSize() * std::sqrt(2.0));
      // From elsewhere the same search tells what a new one would.
      const Point2 elsewhere{place(random), place(random)};
      Route other;
      RouteFinder anew(kTightness);
      const bool leads_there = anew.find(memory_, elsewhere, memory_.bestPlace(to), 1e-9, &other);
      ASSERT_EQ(finder_.findFrom(memory_, elsewhere, &route_), leads_there);
      if (leads_there) {
        ASSERT_EQ(route_.cost, other.cost);
      }
    }
  }
  EXPECT_GT(paths, 60);
  EXPECT_GT(walls, 20);
}

}  // namespace
}  // namespace lstm_planner::test_route_finder
