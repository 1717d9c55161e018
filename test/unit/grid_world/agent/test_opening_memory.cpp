#include <gtest/gtest.h>

#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/grid_world/agent/walk_memory.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_opening_memory {
namespace {

constexpr std::size_t kEast = 0;
constexpr std::size_t kNorth = 2;
constexpr std::size_t kWest = 4;

/// A corridor to the east along row 42, three cells wide, with a branch to the north at column 42.
PassableGrid branchingCorridor() {
  PassableGrid grid(120, 120, false);
  for (int along = 10; along < 110; ++along) {
    for (int across = -1; across <= 1; ++across) {
      grid.set({along, 42 + across}, true);
      if (along > 42) grid.set({42 + across, along}, true);
    }
  }
  return grid;
}

struct Walker {
  Walker(const PassableGrid& world, CellIndex start) : grid(world), cell(start) { look(); }

  void look() {
    trace.visit(cell);
    memory.observe({cell, goal, senseRanges(grid, cell)}, trace);
  }
  void walk(std::size_t direction, int steps) {
    for (int i = 0; i < steps; ++i) {
      cell = cellBeside(cell, static_cast<int>(direction));
      look();
    }
  }
  const std::optional<OpeningMemory::Opening>& behind() const { return memory.openings.bestBehind(); }

  const PassableGrid& grid;
  CellIndex cell;
  CellIndex goal{42, 119};
  VisitTrace trace;
  WalkMemory memory;
};

TEST(OpeningMemory, RemembersABranchThatTheAgentPassedAndHowFarItIsBack) {
  const PassableGrid grid = branchingCorridor();
  Walker walker(grid, {17, 42});
  walker.walk(kEast, 25 + 30);
  ASSERT_TRUE(walker.behind());
  // Nine cells up the branch at column 42, of which the agent is 30 cells east.
  EXPECT_NEAR(walker.behind()->column, 42, 1);
  EXPECT_NEAR(walker.behind()->row, 51, 2);
  EXPECT_NEAR(walker.memory.openings.walkTo(*walker.behind()), 30.0f + 9.0f, 5.0f);
}

TEST(OpeningMemory, TheWalkBackStaysAsLongInAnotherBranch) {
  const PassableGrid grid = branchingCorridor();
  Walker walker(grid, {42, 42});
  walker.walk(kEast, 30);
  walker.walk(kWest, 30);
  // From where the branch leaves the agent goes on, to the west.
  walker.walk(kWest, 25);
  ASSERT_TRUE(walker.behind());
  EXPECT_NEAR(walker.behind()->row, 51, 2);
  EXPECT_NEAR(walker.memory.openings.walkTo(*walker.behind()), 25.0f + 9.0f, 6.0f);
}

TEST(OpeningMemory, ForgetsAnOpeningThatIsVisited) {
  const PassableGrid grid = branchingCorridor();
  Walker walker(grid, {17, 42});
  walker.walk(kEast, 25);
  walker.walk(kNorth, 60);
  ASSERT_TRUE(walker.behind());
  EXPECT_GT(walker.behind()->column, 45) << "what is left is the corridor's end";
  EXPECT_NEAR(walker.behind()->row, 42, 1);
}

TEST(OpeningMemory, ARayShowsHowMuchLongerThePathThroughItsOpeningIs) {
  const PassableGrid grid = branchingCorridor();
  Walker walker(grid, {17, 42});
  walker.walk(kEast, 25);
  const auto& detours = walker.memory.openings.detours();
  ASSERT_TRUE(detours[kNorth] && detours[kEast]);
  EXPECT_FLOAT_EQ(*detours[kNorth], 0.0f);                         // straight towards the goal
  EXPECT_NEAR(*detours[kEast], 9.0f + 9.0f * 0.41421356f, 1e-3f);  // sideways
  EXPECT_FALSE(detours[kWest]) << "there it came from";
}

TEST(OpeningMemory, RemembersNoPlaceThatItHasNoNumberFor) {
  const PassableGrid grid(32900, 9, true);
  Walker walker(grid, {32740, 4});
  walker.walk(kEast, 100);
  // Those to the east are shown by rays only; behind lies the one to the west of the start.
  ASSERT_TRUE(walker.memory.openings.detours()[kEast]);
  ASSERT_TRUE(walker.behind());
  EXPECT_LT(walker.behind()->column, 32740);
  EXPECT_GT(walker.behind()->column, 32700);
}

TEST(OpeningMemory, StaysAsLargeAsItIs) {
  // Wide spaces are full of places that are not visited.
  const PassableGrid grid(2000, 2000, true);
  Walker walker(grid, {1000, 1000});
  Random random(3);
  for (int leg = 0; leg < 200; ++leg) walker.walk(uniformIndex(random, kGridMoveCount), 12);
  ASSERT_TRUE(walker.behind());
  EXPECT_LE(OpeningMemory::bytes(), 4400u);
}

}  // namespace
}  // namespace lstm_planner::test_opening_memory
