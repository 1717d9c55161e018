#include <Eigen/Core>
#include <algorithm>
#include <chrono>

#include "bench_support.hpp"
#include "lstm_planner/network/batch_network.hpp"
#include "lstm_planner/network/network.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner::batch_bench {
namespace {

constexpr int kInputs = 11;
constexpr int kOutputs = 8;
constexpr int kRepetitions = 500;

/// Repeats a step of `agents` agents in short spells, of which the fastest and the middle one are reported: other
/// programs on the machine spoil single spells only.
template <typename Step>
void reportSteps(const LayerStack& layers, InstructionSet set, int agents, const Step& step, benchmark::State& state) {
  const auto weights = static_cast<double>(parameterVector(layers).size());
  const int steps = static_cast<int>(1.0 + 1e6 / (weights * agents));  // 10 us and more
  std::vector<double> agent_ns;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < steps; ++i) step();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    state.SetIterationTime(time.count());
    agent_ns.push_back(1e9 * time.count() / (steps * agents));
  }
  std::sort(agent_ns.begin(), agent_ns.end());
  state.SetLabel(toString(set));
  state.counters["agent_ns"] = agent_ns.front();
  state.counters["agent_ns_median"] = agent_ns[agent_ns.size() / 2];
}

LayerStack layersOf(const benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  return benchLstm(kInputs, {cells, cells}, kOutputs);
}

InstructionSet setOf(const benchmark::State& state) {
  return runnableInstructionSets()[static_cast<std::size_t>(state.range(2))];
}

void batchNetwork(benchmark::State& state) {
  const LayerStack layers = layersOf(state);
  const int agents = static_cast<int>(state.range(1));
  BatchNetwork network(layers, agents, setOf(state));
  const BatchNetwork::Values inputs = BatchNetwork::Values::Random(kInputs, agents);
  const auto step = [&] { benchmark::DoNotOptimize(network.forward(inputs).data()); };
  reportSteps(layers, setOf(state), agents, step, state);
}

/// The same agents one after the other, each with a network of its own.
void singleNetworks(benchmark::State& state) {
  const LayerStack layers = layersOf(state);
  const int agents = static_cast<int>(state.range(1));
  std::vector<Network> networks(static_cast<std::size_t>(agents), Network(layers));
  const Eigen::MatrixXf inputs = Eigen::MatrixXf::Random(kInputs, agents);
  const auto step = [&] {
    Eigen::Index agent = 0;
    for (Network& network : networks) benchmark::DoNotOptimize(network.forward(inputs.col(agent++)).data());
  };
  reportSteps(layers, fastestInstructionSet(), agents, step, state);
}

void addSizes(benchmark::internal::Benchmark* family) {
  const int sets = static_cast<int>(runnableInstructionSets().size());
  for (const int cells : {8, 16, 32, 64}) {
    for (const int agents : {8, 64, 256}) {
      for (int set = 0; set < sets; ++set) family->Args({cells, agents, set});
    }
  }
}
BENCHMARK(batchNetwork)
    ->Name("batch/BatchNetwork")
    ->ArgNames({"cells", "agents", "set"})
    ->Apply(addSizes)
    ->UseManualTime()
    ->Iterations(kRepetitions);
BENCHMARK(singleNetworks)
    ->Name("batch/Networks")
    ->ArgNames({"cells", "agents"})
    ->Apply([](auto* family) {
      addArgumentPairs({8, 16, 32, 64}, {8, 256}, family);
    }) -> UseManualTime() -> Iterations(kRepetitions);

}  // namespace
}  // namespace lstm_planner::batch_bench
