#include <gtest/gtest.h>

#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/grid_world/agent/walk_inputs.hpp"

namespace lstm_planner::test_walk_inputs {
namespace {

std::vector<int> directionsOf(const std::array<float, kGridRayCount>& flags) {
  std::vector<int> directions;
  for (int i = 0; i < kGridRayCount; ++i) {
    if (flags[static_cast<std::size_t>(i)] > 0.0f) directions.push_back(i);
  }
  return directions;
}

TEST(WalkInputs, AHandOnTheWallLeadsAlongIt) {
  // The agent has come from the west, along a wall to the north that has ended: the hand on it leads around its corner
  // as soon as that is passed.
  const GridRanges along = {20, 1, 1, 1, 20, 20, 20, 20};
  WalkInputs inputs(WalkMemory(), {{50, 50}, {90, 50}, along}, 0);
  EXPECT_EQ(directionsOf(inputs.rays[WalkInputs::kLeftHand]), std::vector<int>{0});
  const GridRanges past_corner = {20, 20, 20, 1, 20, 20, 20, 20};
  inputs = WalkInputs(WalkMemory(), {{50, 50}, {90, 50}, past_corner}, 0);
  EXPECT_EQ(directionsOf(inputs.rays[WalkInputs::kLeftHand]), std::vector<int>{2});
  // A wall across the path.
  const GridRanges corner = {1, 1, 1, 1, 20, 20, 20, 1};
  inputs = WalkInputs(WalkMemory(), {{50, 50}, {90, 50}, corner}, 0);
  EXPECT_EQ(directionsOf(inputs.rays[WalkInputs::kLeftHand]), std::vector<int>{6});
  EXPECT_EQ(directionsOf(inputs.rays[WalkInputs::kRightHand]), std::vector<int>{5});
}

TEST(WalkInputs, ThereIsNoHandWithoutAWallOrAStepBefore) {
  const GridRanges open = {20, 20, 20, 20, 20, 20, 20, 20};
  const GridRanges walled = {20, 1, 1, 1, 20, 20, 20, 20};
  EXPECT_TRUE(
      directionsOf(WalkInputs(WalkMemory(), {{50, 50}, {90, 50}, open}, 0).rays[WalkInputs::kLeftHand]).empty());
  EXPECT_TRUE(
      directionsOf(WalkInputs(WalkMemory(), {{50, 50}, {90, 50}, walled}, -1).rays[WalkInputs::kLeftHand]).empty());
}

TEST(WalkInputs, StayInTheirRangeWhateverIsObserved) {
  Random random(5);
  WalkMemory memory;
  VisitTrace trace;
  for (int episode = 0; episode < 20; ++episode) {
    memory.start();
    trace.clear();
    CellIndex cell{static_cast<int>(uniformIndex(random, 8000)) - 4000, static_cast<int>(uniformIndex(random, 8000))};
    const CellIndex goal{static_cast<int>(uniformIndex(random, 8000)), static_cast<int>(uniformIndex(random, 8000))};
    for (int step = 0; step < 500; ++step) {
      GridRanges ranges{};
      for (auto& range : ranges) range = static_cast<std::uint8_t>(1 + uniformIndex(random, kGridRayCap));
      trace.visit(cell);
      const GridObservation observation{cell, goal, ranges};
      memory.observe(observation, trace);
      const int direction = static_cast<int>(uniformIndex(random, kGridMoveCount));
      const WalkInputs inputs(memory, observation, direction);
      const auto check = [](float value) { ASSERT_TRUE(value >= -1.0f && value <= 1.0f) << value; };
      for (const auto& row : inputs.rays) std::for_each(row.begin(), row.end(), check);
      std::for_each(inputs.scalars.begin(), inputs.scalars.end(), check);
      check(inputs.behind_cos);
      check(inputs.behind_sin);
      cell = cellBeside(cell, direction);
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_walk_inputs
