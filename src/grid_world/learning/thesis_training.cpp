#include "lstm_planner/grid_world/learning/thesis_training.hpp"

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner {
namespace {

std::vector<GridCourse::Set> mapsOf(const std::vector<std::string>& scenario_files) {
  std::vector<GridCourse::Set> sets;
  for (const std::string& file : scenario_files) {
    sets.push_back({readMovingAiMap(mapOfScenarioFile(file), PassableRule::kThesis)});
  }
  return sets;
}

}  // namespace

GridImitationParameters thesisTraining() {
  GridImitationParameters parameters = thesisImitation();
  parameters.course.mirrored = false;
  parameters.course.short_share = 0.0;
  parameters.course.long_share = 0.0;
  parameters.course.corner_cutting = CornerCutting::kAllowed;
  parameters.dataset.supervisor = GridSupervisor::kThesisAStar;
  return parameters;
}

const std::vector<ThesisNetwork>& thesisNetworks() {
  using Kind = NetworkShape::Kind;
  static const std::vector<ThesisNetwork> all = {
      {"LSTM 2x8", "thesis_lstm_2x8.onnx", {Kind::kLstm, {8, 8}, {}, {}}, 0.1},
      {"LSTM 2x16", "thesis_lstm_2x16.onnx", {Kind::kLstm, {16, 16}, {}, {}}, 0.1},
      {"MLP 4x64", "thesis_mlp_4x64.onnx", {Kind::kMlp, {64, 64, 64, 64}, {}, {}}, 0.01},
  };
  return all;
}

ThesisNetworkResult trainThesisNetwork(const ThesisNetwork& network, const GridImitationParameters& parameters,
                                       const std::vector<std::string>& training_files,
                                       const std::vector<std::string>& validation_files,
                                       const std::function<bool(double)>& progress) {
  GridImitationParameters own = parameters;
  own.trainer.optimiser.learning_rate = network.learning_rate;
  const LayerStack layers = initialised(makeNetwork(kGridInputs, network.shape, kGridMoveCount), own.seed);
  const auto imitation = gridImitation(own, layers, mapsOf(training_files), mapsOf(validation_files));
  bool go_on = true;
  while (!imitation->done() && go_on) {
    imitation->step();
    go_on = !progress || progress(imitation->progress());
  }
  const TrainingResult result = imitation->roundResult();
  ThesisNetworkResult trained;
  trained.model.layers = result.layers;
  writeGridMetadata(&trained.model.metadata);
  const EpochReport& best = result.best();
  trained.training_accuracy = best.training.accuracy();
  trained.validation_accuracy = best.validation.accuracy();
  return trained;
}

}  // namespace lstm_planner
