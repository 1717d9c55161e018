#include "lstm_planner/grid_world/learning/grid_structure_search.hpp"

#include <map>
#include <mutex>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/training/initialisation.hpp"

namespace lstm_planner {
namespace {

/// Ways of training and validation maps, cut for one time sequence.
struct Dataset {
  std::vector<Sequence> training;
  std::vector<Sequence> validation;
};

Dataset collect(const GridImitationParameters& parameters, int sequence_steps, const GridCourse& training,
                const GridCourse& validation) {
  GridDatasetParameters dataset = parameters.dataset;
  dataset.sequence_steps = sequence_steps;
  Dataset result;
  result.training = collectGridSequences(dataset, training, nullptr, 0.0, parameters.seed, parameters.threads);
  dataset.steps = parameters.validation_steps;
  result.validation = collectGridSequences(dataset, validation, nullptr, 0.0, parameters.seed + 1, parameters.threads);
  return result;
}

/// One trial's training; nothing when `report` ended it.
std::optional<StructureOutcome> run(const StructureTrial& trial, const GridImitationParameters& parameters,
                                    const Dataset& dataset, const EpochCallback& report) {
  const std::vector<int> cells(static_cast<std::size_t>(trial.layers), trial.cells);
  const LayerStack layers = initialised(makeLstmStack(kGridInputs, cells, kGridMoveCount), parameters.seed);
  TrainerParameters trainer = parameters.trainer;
  trainer.batch_size = sequencesWithSteps(trial.sequence_steps, dataset.training);
  trainer.seed = parameters.seed;
  trainer.threads = 1;  // the trials keep the threads busy
  const TrainingResult result = train(layers, dataset.training, dataset.validation, trainer, report);
  if (static_cast<int>(result.curve.size()) < trainer.epochs) return std::nullopt;
  const EpochReport& best = result.best();
  return StructureOutcome{trial, countWeights(layers), best.training.accuracy(), best.validation.accuracy(),
                          result.best_epoch};
}

}  // namespace

std::string StructureTrial::structure() const {
  return std::to_string(layers) + (layers == 1 ? " LSTM layer - " : " LSTM layers - ") + std::to_string(cells) +
         " cells";
}

std::vector<StructureTrial> thesisTrials() {
  return {{1, 1, 4, 128, std::nullopt}, {1, 1, 4, 256, std::nullopt}, {1, 1, 4, 512, 0.8402},  {1, 1, 4, 1024, 0.8211},
          {2, 2, 2, 512, 0.7671},       {2, 2, 2, 1024, 0.7552},      {3, 1, 8, 512, 0.8750},  {3, 1, 8, 1024, 0.8694},
          {3, 2, 4, 512, 0.8456},       {3, 2, 4, 1024, 0.8590},      {4, 1, 16, 512, 0.8837}, {4, 1, 16, 1024, 0.8847},
          {4, 2, 8, 512, 0.8860},       {4, 2, 8, 1024, 0.8845}};
}

std::vector<StructureOutcome> searchGridStructures(const GridImitationParameters& parameters,
                                                   const std::vector<StructureTrial>& trials,
                                                   const std::vector<GridCourse::Set>& training,
                                                   const std::vector<GridCourse::Set>& validation,
                                                   const std::function<bool(double)>& progress) {
  validate(parameters);
  const GridCourse training_course(parameters.course, training, parameters.seed, parameters.threads);
  const GridCourse validation_course(parameters.course, validation, parameters.seed + 1, parameters.threads);
  std::map<int, Dataset> datasets;
  for (const StructureTrial& trial : trials) {
    if (datasets.count(trial.sequence_steps) > 0) continue;
    datasets[trial.sequence_steps] = collect(parameters, trial.sequence_steps, training_course, validation_course);
  }
  std::vector<std::optional<StructureOutcome>> outcomes(trials.size());
  std::mutex mutex;
  bool go_on = true;
  double epochs_done = 0.0;
  const double epochs = static_cast<double>(trials.size()) * parameters.trainer.epochs;
  const auto report = [&](const EpochReport&) {
    const std::lock_guard<std::mutex> lock(mutex);
    epochs_done += 1.0;
    go_on = go_on && (!progress || progress(epochs_done / epochs));
    return go_on;
  };
  parallelFor(static_cast<int>(trials.size()), parameters.threads, [&](int index, int) {
    const auto i = static_cast<std::size_t>(index);
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!go_on) return;
    }
    outcomes[i] = run(trials[i], parameters, datasets.at(trials[i].sequence_steps), report);
  });
  std::vector<StructureOutcome> finished;
  for (const std::optional<StructureOutcome>& outcome : outcomes) {
    if (outcome) finished.push_back(*outcome);
  }
  return finished;
}

}  // namespace lstm_planner
