#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "lstm_planner/base/learning/initialisation.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_network_grid_agent {
namespace {

/// A network that knows nothing: random weights.
Model randomModel(int views, GridEncoderParameters::Inputs inputs = GridEncoderParameters::Inputs::kTrace) {
  GridEncoderParameters parameters;
  parameters.inputs = inputs;
  parameters.views = views;
  const GridEncoder encoder(parameters);
  Model model;
  model.layers = makeLstmStack(encoder.size(), {5}, encoder.outputs());
  initialise({}, 11, model.layers);
  writeMetadata(parameters, &model.metadata);
  return model;
}

/// A cup that opens away from the goal.
PassableGrid cup() {
  PassableGrid grid(40, 40, true);
  for (int i = 10; i <= 30; ++i) {
    grid.set({25, i}, false);
    grid.set({i - 5, 10}, false);
    grid.set({i - 5, 30}, false);
  }
  return grid;
}

int stepsToArrive(NetworkGridAgent& agent, const PassableGrid& grid, CellIndex cell, CellIndex goal, int max_steps) {
  agent.start(cell, goal);
  for (int step = 0; step < max_steps; ++step) {
    if (std::max(std::abs(goal.column - cell.column), std::abs(goal.row - cell.row)) <= 1) return step;
    agent.observe({cell, goal, senseRanges(grid, cell)});
    const int direction = agent.decide();
    if (direction == kNoPath || !movePossible(grid, cell, direction, CornerCutting::kForbidden)) return -1;
    cell = cellBeside(cell, direction);
    agent.step(direction, true);
  }
  return max_steps;
}

TEST(NetworkGridAgent, NeverRunsIntoWhatItSensedHoweverBadTheNetworkIs) {
  for (const int views : {1, 8}) {
    NetworkGridAgent::Options options;
    options.escape = false;
    NetworkGridAgent agent(randomModel(views), options);
    EXPECT_NE(stepsToArrive(agent, cup(), {20, 20}, {35, 20}, 2000), -1);
  }
}

TEST(NetworkGridAgent, LeavesCirclesByDrawingItsMovesEachTimeTheSameOnes) {
  const PassableGrid hall(12, 12, true);
  NetworkGridAgent::Options options;
  options.escape = false;
  constexpr int kMostSteps = 2000;
  NetworkGridAgent circling(randomModel(1, GridEncoderParameters::Inputs::kThesis), options);
  ASSERT_EQ(stepsToArrive(circling, hall, {3, 3}, {9, 9}, kMostSteps), kMostSteps) << "no network that circles";
  options.draw_after = 20;
  NetworkGridAgent drawing(randomModel(1, GridEncoderParameters::Inputs::kThesis), options);
  const int steps = stepsToArrive(drawing, hall, {3, 3}, {9, 9}, kMostSteps);
  EXPECT_LT(steps, kMostSteps);
  EXPECT_EQ(stepsToArrive(drawing, hall, {3, 3}, {9, 9}, kMostSteps), steps);
}

TEST(NetworkGridAgent, ArrivesByTheEscapeHoweverBadTheNetworkIs) {
  NetworkGridAgent::Options options;
  options.rescue.patience = 50;
  NetworkGridAgent agent(randomModel(8), options);
  const int steps = stepsToArrive(agent, cup(), {20, 20}, {35, 20}, 100000);
  EXPECT_GT(steps, 0);
  EXPECT_LT(steps, 100000);
}

TEST(NetworkGridAgent, SaysThatThereIsNoPathToAnEnclosedGoal) {
  PassableGrid grid(30, 30, true);
  for (int i = 12; i <= 18; ++i) {
    for (const CellIndex wall : {CellIndex{i, 12}, CellIndex{i, 18}, CellIndex{12, i}, CellIndex{18, i}}) {
      grid.set(wall, false);
    }
  }
  NetworkGridAgent::Options options;
  options.rescue.patience = 50;
  NetworkGridAgent agent(randomModel(8), options);
  EXPECT_EQ(stepsToArrive(agent, grid, {3, 3}, {15, 15}, 100000), -1);
}

TEST(NetworkGridAgent, ANewEpisodeBeginsLikeTheFirst) {
  NetworkGridAgent agent(randomModel(8), {});
  const int first = stepsToArrive(agent, cup(), {5, 5}, {35, 35}, 5000);
  EXPECT_EQ(stepsToArrive(agent, cup(), {5, 5}, {35, 35}, 5000), first);
}

TEST(NetworkGridAgent, EightViewsTurnWithTheWorld) {
  // The same place turned by a quarter: the same decision, turned by a quarter. 32 cells, as the trace's blocks are to
  // come to lie upon blocks.
  PassableGrid grid(32, 32, true);
  for (int i = 0; i < 12; ++i) grid.set({13, i + 4}, false);
  PassableGrid turned(32, 32, true);
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) turned.set({31 - row, column}, grid.passable({column, row}));
  }
  NetworkGridAgent agent(randomModel(8), {});
  NetworkGridAgent other(randomModel(8), {});
  agent.start({10, 9}, {19, 11});
  other.start({22, 10}, {20, 19});
  agent.observe({{10, 9}, {19, 11}, senseRanges(grid, {10, 9})});
  other.observe({{22, 10}, {20, 19}, senseRanges(turned, {22, 10})});
  EXPECT_EQ(other.decide(), (agent.decide() + 2) % kGridMoveCount);
}

TEST(NetworkGridAgent, RefusesAModelThatWasNotMadeForTheGridWorldOrDoesNotFit) {
  Model model = randomModel(8);
  model.metadata["grid_views"] = "1";
  EXPECT_THROW(NetworkGridAgent(model, {}), std::invalid_argument);
  model.metadata["grid_views"] = "three";
  EXPECT_THROW(NetworkGridAgent(model, {}), std::invalid_argument);
  model.metadata.clear();
  EXPECT_THROW(NetworkGridAgent(model, {}), std::invalid_argument);
}

TEST(NetworkGridAgent, NeedsAtMost64KiBWhateverItMeets) {
  NetworkGridAgent::Options options;
  options.rescue.patience = 20;
  NetworkGridAgent agent(randomModel(8), options);
  stepsToArrive(agent, cup(), {20, 20}, {35, 20}, 100000);
  EXPECT_LE(agent.peakBytes(), 64u * 1024u);
}

}  // namespace
}  // namespace lstm_planner::test_network_grid_agent
