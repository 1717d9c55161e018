#include <gtest/gtest.h>

#include "lstm_planner/grid_world/agent/start_distance.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_start_distance {
namespace {

constexpr std::size_t kEast = 0;
constexpr std::size_t kNorth = 2;
constexpr std::size_t kWest = 4;

/// Walks in straight lines on a map.
struct Walker {
  Walker(const PassableGrid& world, CellIndex start) : grid(world), cell(start) { look(); }

  void look() { distance.observe({cell, {0, 0}, senseRanges(grid, cell)}); }
  void walk(std::size_t direction, int steps) {
    for (int i = 0; i < steps; ++i) {
      cell = cellBeside(cell, static_cast<int>(direction));
      look();
    }
  }

  const PassableGrid& grid;
  CellIndex cell;
  StartDistance distance;
};

TEST(StartDistance, IsTheLengthOfThePathThatLeadsAway) {
  const PassableGrid grid(200, 9, true);
  Walker walker(grid, {10, 4});
  EXPECT_EQ(walker.distance.here(), 0.0f);
  walker.walk(kEast, 100);
  // Blocks are four cells long: their distance is that of the cell where they were entered.
  EXPECT_NEAR(walker.distance.here(), 100.0f, 4.0f);
}

TEST(StartDistance, LeadsBackOutOfADeadEnd) {
  PassableGrid grid(60, 60, false);
  for (int i = 10; i < 50; ++i) grid.set({i, 20}, true);  // east along row 20
  for (int i = 20; i < 50; ++i) grid.set({49, i}, true);  // then north
  Walker walker(grid, {10, 20});
  walker.walk(kEast, 39);
  walker.walk(kNorth, 25);
  // South lies what is nearer to the start, north what was not visited.
  const StartDistance::Ray& back = walker.distance.rays()[6];
  ASSERT_TRUE(back.near && back.far);
  EXPECT_NEAR(walker.distance.here() - *back.near, 5.0f, 4.0f);
  EXPECT_NEAR(walker.distance.here() - *back.far, 18.0f, 4.0f);
  EXPECT_FALSE(walker.distance.rays()[kNorth].near);
}

TEST(StartDistance, OfALoopIsCutShortWhereItsBeginningIsSeen) {
  const PassableGrid grid(100, 100, true);
  Walker walker(grid, {10, 10});
  walker.walk(kEast, 40);
  walker.walk(kNorth, 16);
  walker.walk(kWest, 40);
  // 96 cells were walked; the start lies 16 cells south.
  EXPECT_NEAR(walker.distance.here(), 16.0f, 4.0f);
}

TEST(StartDistance, APlaceAWindowAwayIsNotMistakenForOneThatWasVisited) {
  const PassableGrid grid(600, 9, true);
  Walker walker(grid, {10, 4});
  walker.walk(kEast, 256 - 5);
  EXPECT_FALSE(walker.distance.rays()[kEast].near);
  walker.walk(kEast, 20);
  EXPECT_NEAR(walker.distance.here(), 271.0f, 8.0f);
}

TEST(StartDistance, ForgetsTheEpisodeBefore) {
  const PassableGrid grid(100, 9, true);
  Walker walker(grid, {10, 4});
  walker.walk(kEast, 30);
  walker.distance.clear();
  walker.look();
  EXPECT_EQ(walker.distance.here(), 0.0f);
  EXPECT_FALSE(walker.distance.rays()[kWest].near);
}

}  // namespace
}  // namespace lstm_planner::test_start_distance
