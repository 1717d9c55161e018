#include <memory>

#include "bench_support.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/agent/greedy_agent.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"

namespace lstm_planner::evaluation_bench {
namespace {

CellIndex drawPassable(const PassableGrid& grid, Random& random) {
  CellIndex cell;
  do {
    cell.column = static_cast<int>(uniformIndex(random, static_cast<std::size_t>(grid.columns())));
    cell.row = static_cast<int>(uniformIndex(random, static_cast<std::size_t>(grid.rows())));
  } while (!grid.passable(cell));
  return cell;
}

GridTaskSet benchTasks() {
  constexpr int kTasksAMap = 100;
  GridTaskSet set;
  set.name = "generated";
  set.maps = benchMaps();
  Random random(1);
  for (std::size_t map = 0; map < set.maps.size(); ++map) {
    for (int task = 0; task < kTasksAMap; ++task) {
      // The optimum is for tables; nothing here reads it.
      set.tasks.push_back({map, drawPassable(set.maps[map], random), drawPassable(set.maps[map], random), 1.0});
    }
  }
  return set;
}

/// Episodes of at most 1,000 steps in generated maps, as `lstm_planner evaluate` runs them: sensing, memory, network,
/// shield, move.
void runEpisodes(const GridAgentMaker& make_agent, int threads, benchmark::State& state) {
  const GridTaskSet set = benchTasks();
  GridEvaluationOptions options;
  options.threads = threads;
  double steps = 0.0;
  const WorkMeter meter;
  for (auto _ : state) {
    for (const GridEpisode& episode : evaluateGridTasks(set, 0, set.tasks.size(), make_agent, options)) {
      steps += static_cast<double>(episode.steps());
    }
  }
  meter.report("step", steps, &state);
}

void evaluateNetwork(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  Model model;
  model.layers = benchLstm(kGridInputs, {cells, cells}, kGridMoveCount);
  writeGridMetadata(&model.metadata);
  const auto make_agent = [&](const PassableGrid& /*grid*/) {
    return std::make_unique<NetworkGridAgent>(model, NetworkGridAgent::Options{});
  };
  runEpisodes(make_agent, static_cast<int>(state.range(1)), state);
}
BENCHMARK(evaluateNetwork)
    ->ArgNames({"cells", "threads"})
    ->Args({8, 1})
    ->Args({8, 2})
    ->Args({16, 1})
    ->Args({32, 1})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

/// What a step costs besides the network.
void evaluateGreedy(benchmark::State& state) {
  const auto make_agent = [](const PassableGrid& /*grid*/) {
    return std::make_unique<GreedyAgent>(CornerCutting::kForbidden);
  };
  runEpisodes(make_agent, 1, state);
}
BENCHMARK(evaluateGreedy)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace lstm_planner::evaluation_bench
