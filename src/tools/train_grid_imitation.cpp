#include <iomanip>
#include <iostream>
#include <utility>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/grid_world/learning/grid_imitation.hpp"
#include "lstm_planner/training/learning_curve.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_grid_imitation_options.hpp"
#include "tools/train_grid_judge.hpp"
#include "tools/train_grid_maps.hpp"
#include "tools/training_host.hpp"

namespace lstm_planner {

namespace {

/// Lines printed a round, at most, besides its last.
constexpr int kLinesARound = 20;

class GridImitationHost : public ToolTrainingHost {
 public:
  GridImitationHost(const TrainingLoopOptions& loop, GridJudge judge, int epochs, const ImitationRounds& training)
      : ToolTrainingHost(loop), judge_(std::move(judge)), epochs_(epochs), training_(training) {}

  void stepDone() override {
    const EpochReport& report = training_.epoch();
    const int interval = (epochs_ + kLinesARound - 1) / kLinesARound;
    if (report.epoch % interval == 0 || report.epoch == epochs_) {
      std::cout << table_.line({std::to_string(training_.round()), std::to_string(report.epoch),
                                fixedText(report.training.accuracy(), 4), fixedText(report.validation.accuracy(), 4)})
                << std::endl;
    }
    ToolTrainingHost::stepDone();
  }
  double judge(const LayerStack& layers) override {
    score_ = judge_.judge(layers);
    return score_.mean;
  }
  void keep(const LayerStack& layers) override { judge_.write(layers, score_); }
  void judged(const Judgement& judgement) override {
    std::cout << "round " << training_.round() << ", " << training_.collectedSteps() << " steps, best epoch "
              << training_.roundResult().best_epoch << ": arrival with the shield alone" << std::fixed
              << std::setprecision(3);
    const std::vector<std::string> names = judge_.names();
    for (std::size_t i = 0; i < names.size(); ++i) std::cout << ' ' << names[i] << ' ' << score_.success[i];
    std::cout << ", mean " << score_.mean << (judgement.best ? " (best)" : "") << std::endl;
  }

 private:
  double progress() const override { return training_.progress(); }
  std::string position() const override { return positionOf(training_); }
  std::string scoreText(double score) const override { return namedScore("mean arrival", score); }
  void printHeader() const override { std::cout << table_.headings() << std::endl; }

  const TextTable table_{"round  epoch  training accuracy  validation accuracy"};
  GridJudge judge_;
  int epochs_;  ///< of a round
  const ImitationRounds& training_;
  GridScore score_;  ///< what was judged last
};

int trainByImitation(const std::string& method, const std::vector<std::string>& arguments) {
  GridTrainingOptions options;
  GridImitationParameters parameters;
  TrainingLoopOptions loop;
  if (!readImitationOptions(method, arguments, &options, &parameters, &loop.settings)) return 0;
  loop.checkpoint = options.checkpoint;
  loop.output = options.output;
  loop.communicator = parameters.trainer.communicator = ranks();
  const LayerStack layers = firstLayers(&options);
  parameters.encoder = options.encoder;
  const GridTrainingMaps maps = loadGridTrainingMaps(options);
  const auto training = gridImitation(parameters, layers, maps.training, validationMaps(maps));
  GridImitationHost host(loop, GridJudge(options, maps.validation), parameters.trainer.epochs, *training);
  const TrainingOutcome outcome = runTraining(loop, training.get(), &host);
  if (!options.curve.empty() && isFirstRank()) writeLearningCurve(options.curve, training->curve());
  return host.end(outcome);
}

}  // namespace

int trainGridByImitation(const std::vector<std::string>& arguments) { return trainByImitation("imitation", arguments); }

int trainGridByDagger(const std::vector<std::string>& arguments) { return trainByImitation("dagger", arguments); }

}  // namespace lstm_planner
