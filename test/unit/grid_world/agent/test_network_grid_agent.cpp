#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "support/refusal.hpp"
#include "unit/grid_world/sense_ranges.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_network_grid_agent {
namespace {

/// A network that knows nothing: random weights.
Model randomModel() {
  Model model;
  model.layers = initialised(makeLstmStack(kGridInputs, {5}, kGridMoveCount), 11);
  writeGridMetadata(&model.metadata);
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
  NetworkGridAgent::Options options;
  options.guided = false;
  NetworkGridAgent agent(randomModel(), options);
  EXPECT_NE(stepsToArrive(agent, cup(), {20, 20}, {35, 20}, 2000), -1);
}

TEST(NetworkGridAgent, PrefersWhatItsNetworkInPlainLoopsPrefers) {
  const Model model = randomModel();
  NetworkGridAgent::Options options;
  options.guided = false;
  options.shield = false;
  NetworkGridAgent agent(model, options);
  test::ReferenceNetwork reference(model.layers);
  const PassableGrid grid = cup();
  CellIndex cell{20, 20};
  int previous_direction = kNoPath;
  agent.start(cell, {35, 20});
  for (int step = 0; step < 20; ++step) {
    const GridObservation observation{cell, {35, 20}, senseRanges(grid, cell)};
    agent.observe(observation);
    Eigen::VectorXf input(kGridInputs);
    encodeGrid(observation, previous_direction, input.data(), 1);
    Eigen::Index best = 0;
    reference.forward(input.cast<double>()).maxCoeff(&best);
    ASSERT_EQ(agent.decide(), best) << "step " << step;
    const bool moved = movePossible(grid, cell, agent.decide(), CornerCutting::kForbidden);
    if (moved) cell = cellBeside(cell, agent.decide());
    if (moved) previous_direction = agent.decide();
    agent.step(agent.decide(), moved);
  }
}

TEST(NetworkGridAgent, LeavesCirclesByDrawingItsMovesEachTimeTheSameOnes) {
  const PassableGrid hall(12, 12, true);
  NetworkGridAgent::Options options;
  options.guided = false;
  constexpr int kMostSteps = 2000;
  NetworkGridAgent circling(randomModel(), options);
  ASSERT_EQ(stepsToArrive(circling, hall, {3, 3}, {9, 9}, kMostSteps), kMostSteps) << "no network that circles";
  options.draw_after = 20;
  NetworkGridAgent drawing(randomModel(), options);
  const int steps = stepsToArrive(drawing, hall, {3, 3}, {9, 9}, kMostSteps);
  EXPECT_LT(steps, kMostSteps);
  EXPECT_EQ(stepsToArrive(drawing, hall, {3, 3}, {9, 9}, kMostSteps), steps);
}

TEST(NetworkGridAgent, ArrivesUnderTheBoundHoweverBadTheNetworkIs) {
  NetworkGridAgent::Options options;
  NetworkGridAgent agent(randomModel(), options);
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
  NetworkGridAgent agent(randomModel(), options);
  EXPECT_EQ(stepsToArrive(agent, grid, {3, 3}, {15, 15}, 100000), -1);
}

TEST(NetworkGridAgent, ANewEpisodeBeginsLikeTheFirst) {
  NetworkGridAgent agent(randomModel(), {});
  const int first = stepsToArrive(agent, cup(), {5, 5}, {35, 35}, 5000);
  EXPECT_EQ(stepsToArrive(agent, cup(), {5, 5}, {35, 35}, 5000), first);
}

TEST(NetworkGridAgent, RefusesAModelThatWasNotMadeForTheGridWorldOrDoesNotFit) {
  Model model = randomModel();
  model.layers = makeLstmStack(kGridInputs, {5}, 1);
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { NetworkGridAgent(model, {}); }),
            "the network has 11 inputs and 1 outputs, expected 11 and 8");
  model.metadata.clear();
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { NetworkGridAgent(model, {}); }),
            "the model has no grid_inputs, expected one made for the grid world");
}

TEST(NetworkGridAgent, NeedsAtMost64KiBWhateverItMeets) {
  NetworkGridAgent agent(randomModel(), {});
  stepsToArrive(agent, cup(), {20, 20}, {35, 20}, 100000);
  EXPECT_LE(agent.peakBytes(), 64u * 1024u);
}

/// Prefers the same direction everywhere: the last one, then the one before, and so on.
Model constantModel() {
  Model model = randomModel();
  DenseLayer layer;
  layer.weights.setZero(kGridMoveCount, inputSize(model.layers));
  layer.bias = Eigen::VectorXf::LinSpaced(kGridMoveCount, 0.0f, 7.0f);
  model.layers = {layer};
  return model;
}

/// Of a walk: its steps by who decided and who overruled, and its length.
struct Decisions {
  int network = 0;
  int on_path = 0;
  int by_shield = 0;
  int by_bound = 0;
  int steps = 0;
  double length = 0.0;  ///< cells; a diagonal counts 1.4, as in the remembered path
  double walked = 0.0;  ///< cells
};

Decisions decisionsOf(const Model& model, const DetourParameters& detour, const PassableGrid& grid, CellIndex cell,
                      CellIndex goal) {
  NetworkGridAgent::Options options;
  options.detour = detour;
  NetworkGridAgent agent(model, options);
  Decisions decisions;
  agent.start(cell, goal);
  for (; cell != goal && decisions.steps < 1000; ++decisions.steps) {
    agent.observe({cell, goal, senseRanges(grid, cell)});
    decisions.network += agent.leader() == GridLeader::kNetwork ? 1 : 0;
    decisions.on_path += agent.onPath() ? 1 : 0;
    decisions.by_shield += agent.overruled() == Overruled::kByShield ? 1 : 0;
    decisions.by_bound += agent.overruled() == Overruled::kByBound ? 1 : 0;
    const int direction = agent.decide();
    EXPECT_TRUE(movePossible(grid, cell, direction, CornerCutting::kForbidden));
    cell = cellBeside(cell, direction);
    agent.step(direction, true);
    decisions.length += direction % 2 != 0 ? 1.4 : 1.0;
    decisions.walked += moveLength(direction);
  }
  EXPECT_EQ(cell, goal);
  return decisions;
}

TEST(NetworkGridAgent, IsOverruledByTheBoundWhereItsDetoursWouldBeTooLong) {
  // It always prefers a move that costs 0.8 cells more than the straight one.
  const PassableGrid hall(100, 100, true);
  const Decisions none = decisionsOf(constantModel(), {0.0, 0.0}, hall, {30, 50}, {60, 50});
  EXPECT_EQ(none.steps, 30);
  EXPECT_EQ(none.by_bound, 30);
  const Decisions two = decisionsOf(constantModel(), {1.6, 0.0}, hall, {30, 50}, {60, 50});
  EXPECT_EQ(two.steps, 30);
  EXPECT_EQ(two.network, 2);
  EXPECT_EQ(two.on_path, 0);
  EXPECT_EQ(two.by_bound, 28);
}

TEST(NetworkGridAgent, IsOverruledByTheShieldWhereTheMapEnds) {
  // All moves that it likes better lead out of the map, and the next one is the path.
  const Decisions decisions = decisionsOf(constantModel(), {0.0, 0.0}, PassableGrid(100, 100, true), {60, 0}, {30, 0});
  EXPECT_EQ(decisions.steps, 30);
  EXPECT_EQ(decisions.by_shield, 30);
  EXPECT_EQ(decisions.on_path, 30);
}

TEST(NetworkGridAgent, MakesNoDetourLongerThanTheBoundHoweverBadTheNetworkIs) {
  constexpr DetourParameters kBound{3.0, 0.1};
  constexpr double kOptimum = 20.0 * 1.0 + 10.0 * 1.4;
  const PassableGrid hall(100, 100, true);
  for (const Model& model : {randomModel(), constantModel()}) {
    const Decisions decisions = decisionsOf(model, kBound, hall, {30, 50}, {60, 60});
    EXPECT_GT(decisions.network, 0);
    EXPECT_GT(decisions.by_bound, 0);
    EXPECT_LE(decisions.length, kOptimum + kBound.allowance + kBound.share * decisions.walked);
  }
}

}  // namespace
}  // namespace lstm_planner::test_network_grid_agent
