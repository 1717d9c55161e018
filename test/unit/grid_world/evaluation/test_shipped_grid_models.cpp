#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/grid_world/evaluation/grid_episode.hpp"
#include "lstm_planner/grid_world/world/range_table.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "unit/grid_world/agent/small_grids.hpp"

namespace lstm_planner::test_shipped_grid_models {
namespace {

std::string shippedModel(const std::string& name) {
  return std::string(LSTM_PLANNER_SOURCE_DIR) + "/models/" + name + ".onnx";
}

CellIndex passableCell(const PassableGrid& grid, Random& random) {
  while (true) {
    const CellIndex cell{static_cast<int>(uniformIndex(random, static_cast<std::size_t>(grid.columns()))),
                         static_cast<int>(uniformIndex(random, static_cast<std::size_t>(grid.rows())))};
    if (grid.passable(cell)) return cell;
  }
}

/// A shipped model, and how many of 40 walks it has to end alone, without the bound under which every walk ends.
struct Bound {
  const char* model;
  int arrivals;
};

class ShippedGridModel : public testing::TestWithParam<Bound> {};

/// How many of 40 walks in a random place end alone.
int arrivalsAlone(const Model& model) {
  const PassableGrid grid = generateRandomFill({100, 100, 0.25, true}, 5);
  NetworkGridAgent::Options options;
  options.guided = false;
  NetworkGridAgent agent(model, options);
  const RangeTable ranges(grid);
  Random random(9);
  int arrivals = 0;
  for (int walk = 0; walk < 40; ++walk) {
    const CellIndex goal = passableCell(grid, random);
    const CellIndex start = passableCell(grid, random);
    const GridEpisode episode = runGridEpisode(grid, ranges, start, goal, {}, &agent);
    arrivals += episode.end == GridEpisode::End::kArrived ? 1 : 0;
  }
  return arrivals;
}

TEST_P(ShippedGridModel, ArrivesAloneWhereRandomWeightsDoNot) {
  Model model = readModelFile(shippedModel(GetParam().model));
  EXPECT_GE(arrivalsAlone(model), GetParam().arrivals);
  model.layers = initialised(model.layers, 3);
  EXPECT_LT(arrivalsAlone(model), GetParam().arrivals / 2) << "random weights";
}

TEST_P(ShippedGridModel, ArrivesEverywhereInAMazeWithoutCollision) {
  const PassableGrid maze = generateMaze({100, 100, 8, 0.1}, 5);
  const RangeTable ranges(maze);
  NetworkGridAgent agent(readModelFile(shippedModel(GetParam().model)), {});
  GridEpisodeRules rules;
  rules.max_steps = 5 * 100 * 100;  // the remembered path walks far fewer
  Random random(9);
  for (int walk = 0; walk < 10; ++walk) {
    const CellIndex goal = passableCell(maze, random);
    const CellIndex start = passableCell(maze, random);
    ASSERT_EQ(runGridEpisode(maze, ranges, start, goal, rules, &agent).end, GridEpisode::End::kArrived);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedGridModel,
                         testing::Values(Bound{"grid_lstm_2x8", 10}, Bound{"grid_rnn_2x16", 6},
                                         Bound{"grid_mlp_4x64", 12}, Bound{"grid_qlearning", 20}),
                         [](const auto& info) { return std::string(info.param.model); });

/// Walks in mazes and random fill under the bound: how many end, and the share of the steps that the network decided.
struct UnderBound {
  int arrivals = 0;
  double decided = 0.0;
  std::int64_t peak_bytes = 0;
};

constexpr int kWalksUnderBound = 20;

UnderBound walksUnderBound(const Model& model) {
  UnderBound result;
  double steps = 0.0;
  double by_network = 0.0;
  Random random(9);
  for (int walk = 0; walk < kWalksUnderBound; ++walk) {
    const auto seed = static_cast<std::uint64_t>(walk);
    const PassableGrid grid =
        walk % 2 == 0 ? generateMaze({100, 100, 8, 0.1}, seed) : generateRandomFill({100, 100, 0.25, true}, seed);
    const CellIndex start = passableCell(grid, random);
    const CellIndex goal = passableCell(grid, random);
    NetworkGridAgent agent(model, {});
    const GridEpisode episode = runGridEpisode(grid, RangeTable(grid), start, goal, {}, &agent);
    result.arrivals += episode.end == GridEpisode::End::kArrived ? 1 : 0;
    result.peak_bytes = std::max(result.peak_bytes, episode.peak_bytes);
    steps += static_cast<double>(episode.steps());
    by_network += static_cast<double>(episode.led[static_cast<std::size_t>(GridLeader::kNetwork)]);
  }
  result.decided = by_network / steps;
  return result;
}

/// Prefers the same direction everywhere.
Model constantModel(Model model) {
  DenseLayer layer;
  layer.weights.setZero(kGridMoveCount, inputSize(model.layers));
  layer.bias = Eigen::VectorXf::LinSpaced(kGridMoveCount, 0.0f, 7.0f);
  model.layers = {layer};
  return model;
}

TEST(ShippedGridModels, UnderTheBoundAnyNetworkArrivesButOnlyAGoodOneDecides) {
  const Model shipped = readModelFile(shippedModel("grid_lstm_2x8"));
  const UnderBound good = walksUnderBound(shipped);
  EXPECT_EQ(good.arrivals, kWalksUnderBound);
  EXPECT_GE(good.decided, 0.75);
  Model random = shipped;
  random.layers = initialised(random.layers, 3);
  for (const Model& bad : {random, constantModel(shipped)}) {
    const UnderBound useless = walksUnderBound(bad);
    EXPECT_EQ(useless.arrivals, kWalksUnderBound);
    EXPECT_LT(useless.decided, 0.5);
  }
}

TEST(ShippedGridModels, TheDefaultIsOfTheThesissSizeAndNeedsAtMost64KiBWhereTheTrailHasNoRoom) {
  const Model model = readModelFile(shippedModel("grid_lstm_2x8"));
  EXPECT_LE(countWeights(model.layers), 1256u);
  const SmallGrid maze = pathOfBends();
  NetworkGridAgent::Options options;
  options.guide.most_times_planned = 0.0;
  options.guide.most_steps_more = 0;
  options.guide.last_resort.boundary.first_leg = 4000.0;
  options.guide.last_resort.boundary.goal_weight = 0.0;
  NetworkGridAgent agent(model, options);
  GridEpisodeRules rules;
  rules.max_steps = 5000;
  const GridEpisode episode = runGridEpisode(maze.grid, RangeTable(maze.grid), maze.start, maze.goal, rules, &agent);
  EXPECT_EQ(episode.end, GridEpisode::End::kTimeout);
  EXPECT_GT(episode.led[static_cast<std::size_t>(GridLeader::kBoundary)], 4000);
  EXPECT_LE(agent.peakBytes(), 64u * 1024u);
}

}  // namespace
}  // namespace lstm_planner::test_shipped_grid_models
