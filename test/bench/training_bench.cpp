#include "bench_support.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/training/trainer.hpp"

namespace lstm_planner::training_bench {
namespace {

// The thesis's network and training set (its Table 3.2).
constexpr int kInputs = 11;
constexpr int kOutputs = 8;
constexpr int kTrainingSteps = 102400;
constexpr int kValidationSteps = 10240;
constexpr int kThesisEpochs = 500;
constexpr int kSequenceSteps = 128;

/// The label is the largest of the first inputs one step ago, so that there is something to learn and to remember.
std::vector<Sequence> randomSequences(int steps, std::uint64_t seed) {
  Random random(seed);
  std::vector<Sequence> sequences;
  for (int first = 0; first < steps; first += kSequenceSteps) {
    Sequence sequence{Eigen::MatrixXf(kInputs, kSequenceSteps), Eigen::VectorXi::Zero(kSequenceSteps),
                      Eigen::VectorXf::Ones(kSequenceSteps)};
    for (Eigen::Index i = 0; i < sequence.inputs.size(); ++i) {
      sequence.inputs.data()[i] = static_cast<float>(normal(random));
    }
    for (int step = 1; step < kSequenceSteps; ++step) {
      sequence.inputs.col(step - 1).head(kOutputs).maxCoeff(&sequence.labels[step]);
    }
    sequences.push_back(std::move(sequence));
  }
  return sequences;
}

/// One pass over a training set of `steps` steps.
void trainStep(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  constexpr int kSteps = 256 * kSequenceSteps;
  TrainerParameters parameters;
  parameters.batch_size = static_cast<int>(state.range(1));
  parameters.threads = 1;
  parameters.epochs = 1;
  const LayerStack layers = benchLstm(kInputs, {cells, cells}, kOutputs);
  const std::vector<Sequence> training = randomSequences(kSteps, 1);
  const WorkMeter meter;
  for (auto _ : state) benchmark::DoNotOptimize(train(layers, training, {}, parameters));
  meter.report("sample", static_cast<double>(state.iterations()) * kSteps, &state);
}
BENCHMARK(trainStep)
    ->ArgNames({"cells", "batch"})
    ->Apply([](auto* family) {
      addArgumentPairs({4, 8, 16, 32}, {1, 8, 32, 128}, family);
    }) -> Unit(benchmark::kMillisecond);

/// The thesis's training: its numbers of steps, with validation after every epoch. Batches of 128 sequences.
void thesisTraining(benchmark::State& state) {
  TrainerParameters parameters;
  parameters.epochs = static_cast<int>(state.range(0));
  parameters.threads = static_cast<int>(state.range(1));
  const LayerStack layers = benchLstm(kInputs, {8, 8}, kOutputs);
  const std::vector<Sequence> training = randomSequences(kTrainingSteps, 1);
  const std::vector<Sequence> validation = randomSequences(kValidationSteps, 2);
  const WorkMeter meter;
  for (auto _ : state) {
    const TrainingResult result = train(layers, training, validation, parameters);
    state.counters["accuracy"] = result.best().validation.accuracy();
  }
  const double samples = static_cast<double>(state.iterations()) * parameters.epochs * kTrainingSteps;
  meter.report("sample", samples, &state);
  const double all_samples = static_cast<double>(kThesisEpochs) * kTrainingSteps;
  state.counters["s_for_500_epochs"] = all_samples / state.counters["samples_per_s"];
}
BENCHMARK(thesisTraining)
    ->ArgNames({"epochs", "threads"})
    ->Args({5, 1})
    ->Args({5, 2})
    ->Args({kThesisEpochs, 2})
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace lstm_planner::training_bench
