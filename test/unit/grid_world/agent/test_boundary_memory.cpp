#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/agent/boundary_inputs.hpp"
#include "lstm_planner/grid_world/agent/boundary_memory.hpp"
#include "unit/grid_world/agent/small_grids.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_boundary_memory {
namespace {

constexpr int kEast = 0;
constexpr int kNorthEast = 1;
constexpr int kNorth = 2;
constexpr int kWest = 4;
constexpr int kSouth = 6;

/// Walks over a drawn grid; rows grow to the north.
class Walker {
 public:
  explicit Walker(const SmallGrid& world) : world_(world), cell_(world.start) { observe(); }

  void go(int direction, int steps = 1) {
    for (int step = 0; step < steps; ++step) {
      ASSERT_TRUE(movePossible(world_.grid, cell_, direction, CornerCutting::kForbidden));
      cell_ = cellBeside(cell_, direction);
      observe();
    }
  }

  const BoundaryMemory& memory() const { return memory_; }
  GridObservation observation() const { return {cell_, world_.goal, senseRanges(world_.grid, cell_)}; }
  CellIndex cell() const { return cell_; }

 private:
  void observe() { memory_.observe(observation()); }

  SmallGrid world_;
  CellIndex cell_;
  BoundaryMemory memory_;
};

/// A wall across the path to the goal.
SmallGrid walled() {
  return drawnGrid({
      "............",
      "......#.....",
      "......#.....",
      "......#.....",
      "...S..#....G",
      "......#.....",
      "......#.....",
      "......#.....",
      "............",
  });
}

TEST(BoundaryMemory, EachHandOnTheObstacleAheadLeadsAlongIt) {
  Walker walker(walled());
  walker.go(kEast, 2);
  EXPECT_FALSE(walker.memory().hand());
  EXPECT_EQ(walker.memory().directionByHand(WallSide::kRight), kNorth);
  EXPECT_EQ(walker.memory().directionByHand(WallSide::kLeft), kSouth);
}

TEST(BoundaryMemory, TheHandOnTheWallIsThatWhichLedToTheMoveAndLeadsRoundTheCorner) {
  Walker walker(walled());
  walker.go(kEast, 2);
  walker.go(kNorth, 3);
  ASSERT_EQ(walker.memory().hand(), WallSide::kRight);
  EXPECT_EQ(walker.memory().directionByHand(WallSide::kRight), kNorth) << "corners may not be cut";
  walker.go(kNorth);
  EXPECT_EQ(walker.memory().directionByHand(WallSide::kRight), kEast);
  EXPECT_DOUBLE_EQ(walker.memory().leg(), 4.0);
  EXPECT_EQ(walker.memory().directionToEnd(WallSide::kRight), kNoPath) << "it takes this end along";
  EXPECT_EQ(walker.memory().directionToEnd(WallSide::kLeft), kSouth);
  EXPECT_DOUBLE_EQ(walker.memory().lengthToEnd(WallSide::kLeft), 4.0);
}

TEST(BoundaryMemory, TurningBackIsAReturnToTheOtherEndUntilItIsReached) {
  Walker walker(walled());
  walker.go(kEast, 2);
  walker.go(kNorth, 3);
  walker.go(kSouth);
  EXPECT_EQ(walker.memory().hand(), WallSide::kLeft);
  EXPECT_TRUE(walker.memory().returning());
  EXPECT_EQ(walker.memory().directionToEnd(WallSide::kRight), kNorth) << "where it turned back";
  walker.go(kSouth, 2);
  EXPECT_FALSE(walker.memory().returning());
  EXPECT_DOUBLE_EQ(walker.memory().pathBack(), 3.0);
  EXPECT_DOUBLE_EQ(walker.memory().leg(), 0.0);
  EXPECT_EQ(walker.memory().directionByHand(WallSide::kLeft), kSouth);
  const double here = octileDistance(walker.cell(), walled().goal).length();
  const double there =
      octileDistance(cellBeside(cellBeside(cellBeside(walker.cell(), kNorth), kNorth), kNorth), walled().goal).length();
  EXPECT_DOUBLE_EQ(walker.memory().otherEndFarther(), there - here);
}

TEST(BoundaryMemory, IsForgottenAsSoonAsTheAgentIsNearerToTheGoalThanEver) {
  Walker walker(walled());
  walker.go(kEast, 2);
  walker.go(kNorth, 4);
  walker.go(kEast, 4);
  EXPECT_FALSE(walker.memory().hand());
  EXPECT_EQ(walker.memory().directionToEnd(WallSide::kLeft), kNoPath);
  EXPECT_DOUBLE_EQ(walker.memory().leg(), 0.0);
  EXPECT_EQ(walker.memory().best(), octileDistance(walker.cell(), walled().goal));
}

TEST(BoundaryMemory, AJumpOrAnotherGoalIsANewStart) {
  const SmallGrid world = walled();
  for (const bool jumps : {true, false}) {
    Walker walker(world);
    walker.go(kEast, 2);
    walker.go(kNorth, 3);
    BoundaryMemory memory = walker.memory();
    GridObservation observation = walker.observation();
    if (jumps) {
      observation.cell = {0, 0};
    } else {
      observation.goal = {0, 0};
    }
    memory.observe(observation);
    EXPECT_FALSE(memory.hand());
    EXPECT_EQ(memory.best(), octileDistance(observation.cell, observation.goal));
  }
}

TEST(BoundaryMemory, TheTrailBackLeavesOutDeadEnds) {
  // Along the right hand's wall into a pocket and out of it again: back it is straight past the pocket.
  const SmallGrid world = drawnGrid({
      "......#.....",
      "......#.....",
      "...S..#....G",
      "......#.....",
      "......#.....",
      "......#.....",
      "......#.....",
      "......#.....",
      "......####..",
      ".........#..",
      "......####..",
      "......#.....",
  });
  Walker walker(world);
  walker.go(kEast, 2);
  walker.go(kNorth, 7);
  walker.go(kEast, 3);
  walker.go(kWest, 3);
  walker.go(kNorth, 2);
  EXPECT_EQ(walker.memory().hand(), WallSide::kRight);
  EXPECT_DOUBLE_EQ(walker.memory().leg(), 15.0);
  EXPECT_DOUBLE_EQ(walker.memory().lengthToEnd(WallSide::kLeft), 9.0);
}

TEST(BoundaryInputs, SayHowMuchNearerARayLeadsThanEverBefore) {
  Walker walker(walled());
  walker.go(kEast, 2);
  BoundaryInputs inputs(walker.memory(), walker.observation());
  EXPECT_FLOAT_EQ(inputs.rays[BoundaryInputs::kNearer][kEast], 0.0f) << "an obstacle";
  EXPECT_FLOAT_EQ(inputs.rays[BoundaryInputs::kNearer][kNorth], 0.0f) << "no cell of that ray is nearer";
  walker.go(kNorth, 4);
  inputs = BoundaryInputs(walker.memory(), walker.observation());
  // From 6 east of the agent the goal is 4 south: nearer by 6 - 4 cells, and half of that is the scale.
  EXPECT_FLOAT_EQ(inputs.rays[BoundaryInputs::kNearer][kEast], 0.5f);
  EXPECT_LT(inputs.rays[BoundaryInputs::kNearer][kNorthEast], 0.0f);
  EXPECT_FLOAT_EQ(inputs.rays[BoundaryInputs::kOtherEnd][kSouth], 1.0f);
  EXPECT_FLOAT_EQ(inputs.scalars[BoundaryInputs::kHand], -1.0f);
}

TEST(BoundaryInputs, StayInTheirRangeWhateverIsObserved) {
  Random random(5);
  BoundaryMemory memory;
  for (int episode = 0; episode < 20; ++episode) {
    memory.start();
    CellIndex cell{static_cast<int>(uniformIndex(random, 8000)) - 4000, static_cast<int>(uniformIndex(random, 8000))};
    const CellIndex goal{static_cast<int>(uniformIndex(random, 8000)), static_cast<int>(uniformIndex(random, 8000))};
    for (int step = 0; step < 2000; ++step) {
      GridRanges ranges{};
      for (auto& range : ranges) range = static_cast<std::uint8_t>(1 + uniformIndex(random, kGridRayCap));
      const GridObservation observation{cell, goal, ranges};
      memory.observe(observation);
      const BoundaryInputs inputs(memory, observation);
      const auto check = [](float value) { ASSERT_TRUE(value >= -1.0f && value <= 1.0f) << value; };
      for (const auto& row : inputs.rays) std::for_each(row.begin(), row.end(), check);
      std::for_each(inputs.scalars.begin(), inputs.scalars.end(), check);
      cell = cellBeside(cell, static_cast<int>(uniformIndex(random, kGridMoveCount)));
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_boundary_memory
