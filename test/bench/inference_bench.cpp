#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

#include "bench_support.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/network/network.hpp"

namespace lstm_planner::inference_bench {
namespace {

constexpr int kInputs = 11;
constexpr int kOutputs = 8;

/// Steps whose first input is the last step's first output, the rest constant: no step can start before the one before
/// it is through, as in a drive. The time of a step is the least of many short runs, which other programs on the
/// machine hardly change.
class ChainedSteps {
 public:
  explicit ChainedSteps(int cells) : steps_a_run_(std::max(20000 / cells / cells, 50)), input_(kInputs) {
    for (int i = 0; i < kInputs; ++i) input_(i) = 0.1f * static_cast<float>(i) - 0.5f;
  }

  template <class Forward>
  void run(const Forward& forward) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    for (int step = 0; step < steps_a_run_; ++step) input_(0) = forward(input_)(0);
    const std::chrono::duration<double, std::nano> time = Clock::now() - begin;
    least_ns_ = std::min(least_ns_, time.count() / steps_a_run_);
  }

  double leastNs() const { return least_ns_; }

 private:
  int steps_a_run_;
  Eigen::VectorXf input_;
  double least_ns_ = std::numeric_limits<double>::infinity();
};

/// 11 -> LSTM -> LSTM -> FC 8 with one kernel.
void inferenceKernel(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  const InstructionSet set = runnableInstructionSets()[static_cast<std::size_t>(state.range(1))];
  Network network(benchLstm(kInputs, {cells, cells}, kOutputs), set);
  ChainedSteps steps(cells);
  for (auto _ : state) {
    steps.run([&](const Eigen::VectorXf& input) -> const Eigen::VectorXf& { return network.forward(input); });
  }
  state.SetLabel(toString(set));
  state.counters["step_ns"] = steps.leastNs();
}
BENCHMARK(inferenceKernel)
    ->Name("inference/step")
    ->ArgNames({"cells", "set"})
    ->Apply([](auto* family) {
      std::vector<int> sets;
      for (std::size_t i = 0; i < runnableInstructionSets().size(); ++i) sets.push_back(static_cast<int>(i));
      addArgumentPairs({8, 16, 32, 64, 33}, sets, family);
    }) -> Unit(benchmark::kMicrosecond);

/// A step of all eight views of the shipped network, one after the other.
void inferenceViews(benchmark::State& state) {
  constexpr int kViews = 8;
  const LayerStack layers = readModelFile(LSTM_PLANNER_SOURCE_DIR "/models/create2_lstm.onnx").layers;
  const InstructionSet set = runnableInstructionSets()[static_cast<std::size_t>(state.range(0))];
  Network network(layers, set, kViews);
  const Eigen::MatrixXf inputs = Eigen::MatrixXf::Random(network.inputSize(), kViews);
  for (auto _ : state) {
    for (int view = 0; view < kViews; ++view) {
      benchmark::DoNotOptimize(network.forward(inputs.col(view), view).data());
    }
  }
  state.SetLabel(toString(set));
}
BENCHMARK(inferenceViews)->ArgNames({"set"})->Apply([](auto* family) {
  for (std::size_t i = 0; i < runnableInstructionSets().size(); ++i) family->Arg(static_cast<int>(i));
});

}  // namespace
}  // namespace lstm_planner::inference_bench
