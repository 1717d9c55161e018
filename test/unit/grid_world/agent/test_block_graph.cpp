#include <gtest/gtest.h>

#include "lstm_planner/grid_world/agent/block_graph.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_block_graph {
namespace {

using Cell = SeenGrid::Cell;
using Passage = BlockGraph::Passage;

constexpr std::size_t kEast = 0;
constexpr std::size_t kNorth = 2;

/// A seen grid and the graph of its blocks, as an agent keeps them that walks about.
struct Memory {
  explicit Memory(const PassableGrid& world, CellIndex cell) : grid(world) {
    seen.restart(cell);
    graph.restart(seen, cell);
    lookFrom(cell);
  }
  void lookFrom(CellIndex cell) {
    seen.observe({cell, goal, senseRanges(grid, cell)});
    graph.update(seen, cell, goal);
  }
  void walk(CellIndex from, CellIndex to, CellIndex step) {
    for (CellIndex cell = from; cell != to; cell = {cell.column + step.column, cell.row + step.row}) lookFrom(cell);
  }

  const PassableGrid& grid;
  CellIndex goal{1000, 1000};
  SeenGrid seen;
  BlockGraph graph;
};

/// A wall one cell thick along column 41, in the middle of the blocks from column 40 on; it has a gap in row 30.
PassableGrid walledGrid(int columns) {
  PassableGrid grid(columns, 61, true);
  for (int row = 0; row < 61; ++row) grid.set({41, row}, row == 30);
  return grid;
}

TEST(SeenGrid, KnowsWhatRaysWentThroughAndWhereTheyEnded) {
  const PassableGrid grid = walledGrid(100);
  const Memory memory(grid, {38, 20});
  EXPECT_EQ(memory.seen.at({40, 20}), Cell::kFree);
  EXPECT_EQ(memory.seen.at({41, 20}), Cell::kWall);
  EXPECT_EQ(memory.seen.at({42, 20}), Cell::kUnknown);
  EXPECT_EQ(memory.seen.at({38, -1}), Cell::kWall);
}

TEST(SeenGrid, DoubtsSmallGapsBetweenWallsUntilItSeesThrough) {
  const PassableGrid grid = walledGrid(100);
  Memory memory(grid, {38, 28});
  memory.lookFrom({38, 32});
  EXPECT_EQ(memory.seen.at({41, 30}), Cell::kDoubtful);
  memory.lookFrom({38, 30});
  EXPECT_EQ(memory.seen.at({41, 30}), Cell::kFree);
}

TEST(BlockGraph, AWallOneCellThickSeparatesItsTwoSides) {
  const PassableGrid grid = walledGrid(100);
  Memory memory(grid, {30, 8});
  memory.walk({30, 8}, {30, 16}, {0, 1});
  // The blocks from column 40 stand for what lies behind the wall, the larger piece.
  EXPECT_EQ(memory.graph.passage(blockOf({36, 12}), kEast), Passage::kClosed);
  EXPECT_EQ(memory.graph.passage(blockOf({32, 12}), kEast), Passage::kFree);
  EXPECT_EQ(memory.graph.passage(blockOf({28, 8}), kNorth), Passage::kFree);
  EXPECT_EQ(memory.graph.passage(blockOf({44, 12}), kEast), Passage::kUnknown);
}

TEST(BlockGraph, ALittleBesideAGapItLeadsThroughTheGap) {
  const PassableGrid grid = walledGrid(100);
  Memory memory(grid, {38, 22});
  memory.walk({38, 22}, {38, 30}, {0, 1});
  memory.walk({38, 30}, {43, 30}, {1, 0});
  memory.walk({43, 30}, {43, 22}, {0, -1});
  EXPECT_EQ(memory.graph.passage(blockOf({36, 28}), kEast), Passage::kFree) << "the gap lies in the block behind";
  EXPECT_EQ(memory.graph.passage(blockOf({36, 24}), kEast), Passage::kFree) << "beside the block behind";
  EXPECT_EQ(memory.graph.passage(blockOf({36, 20}), kEast), Passage::kClosed) << "the next but one is too far";
}

TEST(BlockGraph, RemembersAWallWhoseCellsAreForgotten) {
  const PassableGrid grid = walledGrid(600);
  Memory memory(grid, {30, 8});
  memory.walk({30, 8}, {30, 16}, {0, 1});
  memory.walk({43, 30}, {400, 30}, {1, 0});
  ASSERT_EQ(memory.seen.at({41, 12}), Cell::kUnknown);
  EXPECT_EQ(memory.graph.passage(blockOf({36, 12}), kEast), Passage::kClosed);
  // Nor does it forget when it comes back and sees but a part.
  memory.walk({400, 30}, {43, 30}, {-1, 0});
  memory.lookFrom({44, 13});
  EXPECT_EQ(memory.graph.passage(blockOf({36, 12}), kEast), Passage::kClosed);
}

TEST(BlockGraph, FromWhereTheAgentStandsItCountsWhatTheAgentCanReach) {
  const PassableGrid grid = walledGrid(100);
  Memory memory(grid, {40, 8});
  memory.walk({40, 8}, {40, 20}, {0, 1});
  const CellIndex agent = {40, 13};
  EXPECT_EQ(memory.graph.passageFrom(memory.seen, agent, 4), Passage::kFree);
  EXPECT_EQ(memory.graph.passageFrom(memory.seen, agent, kEast), Passage::kClosed);
}

}  // namespace
}  // namespace lstm_planner::test_block_graph
