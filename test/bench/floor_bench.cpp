#include "bench_support.hpp"
#include "floor.hpp"

namespace lstm_planner::floor_bench {
namespace {

InstructionSet instructionSet(const benchmark::State& state, int argument) {
  return runnableInstructionSets()[static_cast<std::size_t>(state.range(argument))];
}

void addInstructionSets(benchmark::internal::Benchmark* family) {
  for (std::size_t i = 0; i < runnableInstructionSets().size(); ++i) family->Arg(static_cast<int>(i));
}

/// What one core does at best; its time means nothing, its counters do.
void floorOfCore(benchmark::State& state) {
  const InstructionSet set = instructionSet(state, 0);
  const CoreSpeed& speed = measuredSpeed(set);
  for (auto _ : state) benchmark::DoNotOptimize(&speed);
  state.SetLabel(toString(set));
  state.counters["multiply_add_ns"] = speed.multiply_add_ns;
  state.counters["multiplication_ns"] = speed.multiplication_ns;
  state.counters["addition_ns"] = speed.addition_ns;
  state.counters["division_ns"] = speed.division_ns;
  state.counters["broadcast_ns"] = speed.broadcast_ns;
  state.counters["multiply_adds_per_ns"] = speed.multiply_adds_per_ns;
  state.counters["l1_bytes_per_ns"] = speed.l1_bytes_per_ns;
  state.counters["l2_bytes_per_ns"] = speed.l2_bytes_per_ns;
}
BENCHMARK(floorOfCore)->Name("floor/core")->ArgName("set")->Apply(addInstructionSets)->Iterations(1);

/// What no step of 11 -> LSTM -> LSTM -> FC 8 goes below.
void floorOfStep(benchmark::State& state) {
  const InstructionSet set = instructionSet(state, 1);
  const int cells = static_cast<int>(state.range(0));
  const LayerStack layers = benchLstm(11, {cells, cells}, 8);
  const StepFloor floor = stepFloorParts(layers, set);
  for (auto _ : state) benchmark::DoNotOptimize(&floor);
  state.SetLabel(toString(set));
  state.counters["floor_ns"] = floor.ns();
  state.counters["chain_ns"] = floor.chain;
  state.counters["multiply_ns"] = floor.multiply;
  state.counters["read_ns"] = floor.read;
  state.counters["read_in_order_ns"] = readInOrder(layers, set);
}
BENCHMARK(floorOfStep)
    ->Name("floor/step")
    ->ArgNames({"cells", "set"})
    ->Apply([](auto* family) {
      std::vector<int> sets;
      for (std::size_t i = 0; i < runnableInstructionSets().size(); ++i) sets.push_back(static_cast<int>(i));
      addArgumentPairs({8, 16, 32, 64}, sets, family);
    }) -> Iterations(1);

}  // namespace
}  // namespace lstm_planner::floor_bench
