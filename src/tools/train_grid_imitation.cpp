#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "lstm_planner/base/learning/learning_curve.hpp"
#include "lstm_planner/base/learning/training_checkpoint.hpp"
#include "lstm_planner/grid_world/learning/grid_imitation.hpp"
#include "tools/interruption.hpp"
#include "tools/progress.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_grid_imitation_options.hpp"
#include "tools/train_grid_judge.hpp"
#include "tools/train_grid_maps.hpp"

namespace lstm_planner {

namespace {

/// Lines printed a round, at most, besides its last.
constexpr int kLinesARound = 20;

/// Between checkpoints: epochs of small networks take less time than writing.
constexpr std::chrono::seconds kCheckpointInterval{5};

class ImitationTraining {
 public:
  ImitationTraining(GridTrainingOptions options, GridImitationParameters parameters, nlohmann::json settings)
      : options_(std::move(options)),
        parameters_(std::move(parameters)),
        settings_(std::move(settings)),
        layers_(firstLayers(&options_)),
        maps_(loadGridTrainingMaps(options_)),
        judge_(options_, maps_.validation) {
    parameters_.encoder = options_.encoder;
    parameters_.trainer.communicator = ranks();
  }

  int run() {
    const Interruption interruption;
    const GridImitationState begun = restore();
    std::cout << std::fixed << "round  epoch  training accuracy  validation accuracy" << std::endl;
    const auto epoch_done = [&](int round, const EpochReport& report, const GridImitationState& state) {
      printEpoch(round, report);
      bar_.show((round - 1 + static_cast<double>(report.epoch) / options_.epochs) / parameters_.rounds);
      const bool stop = interruption.wanted();
      const bool last = round == parameters_.rounds && report.epoch == options_.epochs;
      writeCheckpoint(state, stop || last);
      interrupted_ = stop && !last;
      return !stop;
    };
    const auto round_done = [&](const GridImitationRound& round) { judgeRound(round); };
    const GridImitationResult result =
        imitateOnGrid(parameters_, layers_, maps_.training, validationMaps(maps_), epoch_done, round_done, begun);
    if (!options_.curve.empty() && isFirstRank()) {
      const std::string stem = options_.curve.substr(0, options_.curve.rfind('.'));
      writeLearningCurve(stem + ".csv", options_.curve, result.curve);
    }
    std::cout << "wrote " << options_.output << ": mean arrival " << judge_.best() << std::endl;
    if (!interrupted_) return 0;
    std::cout << "interrupted; "
              << (options_.checkpoint.empty() ? "without --checkpoint the training cannot be gone on with"
                                              : "the same command goes on from here")
              << std::endl;
    return interruption.exitStatus();
  }

 private:
  GridImitationState restore() {
    if (options_.checkpoint.empty()) return {};
    const auto checkpoint = readTrainingCheckpoint(options_.checkpoint, settings_);
    if (!checkpoint) return {};
    judge_.restore(checkpoint->progress);
    GridImitationState state = gridImitationStateFrom(checkpoint->learner);
    std::cout << "going on from " << options_.checkpoint << " after " << state.learners.size() << " rounds and "
              << state.training.curve.size() << " epochs" << std::endl;
    return state;
  }

  void writeCheckpoint(const GridImitationState& state, bool at_once) {
    if (!isFirstRank()) return;
    const auto now = std::chrono::steady_clock::now();
    if (options_.checkpoint.empty() || (!at_once && now < last_checkpoint_ + kCheckpointInterval)) return;
    last_checkpoint_ = now;
    writeTrainingCheckpoint(options_.checkpoint, {settings_, judge_.state(), toBytes(state)});
  }

  void printEpoch(int round, const EpochReport& report) const {
    const int interval = (options_.epochs + kLinesARound - 1) / kLinesARound;
    if (report.epoch % interval != 0 && report.epoch != options_.epochs) return;
    std::cout << std::setw(5) << round << std::setw(7) << report.epoch << std::setprecision(4) << std::setw(19)
              << report.training.accuracy() << std::setw(21) << report.validation.accuracy() << std::endl;
  }

  void judgeRound(const GridImitationRound& round) {
    // What a break leaves is judged where nothing else is kept; else the round will end first.
    if (interrupted_ && !options_.checkpoint.empty() && judge_.best() >= 0.0) return;
    const GridScore score = judge_.judge(round.training.layers);
    const bool best = judge_.keepIfBest(round.training.layers, score);
    std::cout << "round " << round.round << ", " << round.steps << " steps, best epoch " << round.training.best_epoch
              << ": arrival with the shield alone" << std::setprecision(3);
    const std::vector<std::string> names = judge_.names();
    for (std::size_t i = 0; i < names.size(); ++i) std::cout << ' ' << names[i] << ' ' << score.success[i];
    std::cout << ", mean " << score.mean << (best ? " (best)" : "") << std::endl;
  }

  GridTrainingOptions options_;
  GridImitationParameters parameters_;
  nlohmann::json settings_;
  LayerStack layers_;
  GridTrainingMaps maps_;
  GridJudge judge_;
  Progress bar_;
  bool interrupted_ = false;
  std::chrono::steady_clock::time_point last_checkpoint_;
};

int trainByImitation(const std::string& method, const std::vector<std::string>& arguments) {
  GridTrainingOptions options;
  GridImitationParameters parameters;
  nlohmann::json settings;
  if (!readImitationOptions(method, arguments, &options, &parameters, &settings)) return 0;
  return ImitationTraining(std::move(options), std::move(parameters), std::move(settings)).run();
}

}  // namespace

int trainGridByImitation(const std::vector<std::string>& arguments) { return trainByImitation("imitation", arguments); }

int trainGridByDagger(const std::vector<std::string>& arguments) { return trainByImitation("dagger", arguments); }

}  // namespace lstm_planner
