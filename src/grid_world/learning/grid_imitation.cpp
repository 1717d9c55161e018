#include "lstm_planner/grid_world/learning/grid_imitation.hpp"

#include <utility>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/network/model_file.hpp"

namespace lstm_planner {
namespace {

constexpr double kLearnerShare = 0.8;  ///< of the paths, from the second round on

class GridImitationCourse : public ImitationCourse {
 public:
  GridImitationCourse(const GridImitationParameters& parameters, std::vector<GridCourse::Set> training,
                      const std::vector<GridCourse::Set>& validation)
      : parameters_(parameters),
        training_maps_(std::move(training)),
        validation_course_(parameters.course, validation, seedOf(0, true), parameters.threads) {}

  std::vector<Sequence> collectTraining(int round, const LayerStack* learner) override {
    const std::uint64_t seed = seedOf(round, false);
    const GridCourse course(parameters_.course, training_maps_, seed, parameters_.threads);
    return collect(parameters_.dataset, course, learner, kLearnerShare, seed);
  }

  std::vector<Sequence> collectValidation(int round, const LayerStack* learner) override {
    GridDatasetParameters dataset = parameters_.dataset;
    dataset.steps = parameters_.validation_steps;
    return collect(dataset, validation_course_, learner, 1.0, seedOf(round, true));
  }

 private:
  std::uint64_t seedOf(int round, bool validation) const {
    return parameters_.seed * 1000003ULL + static_cast<std::uint64_t>(round) * 2ULL + (validation ? 1ULL : 0ULL);
  }

  std::vector<Sequence> collect(const GridDatasetParameters& dataset, const GridCourse& course,
                                const LayerStack* learner, double learner_share, std::uint64_t seed) const {
    Model model;
    if (learner != nullptr) model.layers = *learner;
    writeGridMetadata(&model.metadata);
    return collectGridSequences(dataset, course, learner != nullptr ? &model : nullptr, learner_share, seed,
                                parameters_.threads);
  }

  const GridImitationParameters parameters_;
  const std::vector<GridCourse::Set> training_maps_;
  const GridCourse validation_course_;
};

}  // namespace

GridImitationParameters thesisImitation() {
  GridImitationParameters parameters;
  parameters.batch_steps = parameters.dataset.sequence_steps;
  TrainerParameters& trainer = parameters.trainer;
  trainer.epochs = 500;
  trainer.optimiser.kind = OptimiserKind::kMomentum;
  trainer.optimiser.learning_rate = 0.1;
  trainer.optimiser.schedule = LearningRateSchedule::kConstant;
  trainer.optimiser.momentum = 0.95;
  trainer.optimiser.l1_decay = 1e-5;
  return parameters;
}

void validate(const GridImitationParameters& parameters) {
  validate(parameters.course);
  validate(parameters.dataset);
  validate(parameters.trainer);
  visitGridImitationParameters(parameters, RangeCheck());
  checkAtLeastOne("rounds", parameters.rounds);
  checkPositive("threads", parameters.threads);
}

std::unique_ptr<ImitationRounds> gridImitation(const GridImitationParameters& parameters, const LayerStack& layers,
                                               std::vector<GridCourse::Set> training,
                                               const std::vector<GridCourse::Set>& validation) {
  validate(parameters);
  ImitationRoundsParameters rounds;
  rounds.rounds = parameters.rounds;
  rounds.batch_steps = parameters.batch_steps;
  rounds.trainer = parameters.trainer;
  rounds.trainer.seed = parameters.seed;
  rounds.trainer.threads = parameters.threads;
  return std::make_unique<ImitationRounds>(
      rounds, layers, std::make_unique<GridImitationCourse>(parameters, std::move(training), validation));
}

}  // namespace lstm_planner
