#include "lstm_planner/training/trainer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner {
namespace {

using Batch = SequenceGradient::Batch;

Batch pointersTo(const std::vector<Sequence>& sequences) {
  Batch pointers;
  for (const Sequence& sequence : sequences) pointers.push_back(&sequence);
  return pointers;
}

/// Batches of at most `size` sequences, as equal as can be: a small rest would make a noisy update.
std::vector<Batch> cut(const Batch& sequences, int size) {
  const std::size_t count = (sequences.size() + static_cast<std::size_t>(size) - 1) / static_cast<std::size_t>(size);
  std::vector<Batch> batches(count);
  for (std::size_t index = 0; index < sequences.size(); ++index) {
    batches[index * count / sequences.size()].push_back(sequences[index]);
  }
  return batches;
}

bool isBetter(const LossSum& candidate, const LossSum& best) {
  if (candidate.accuracy() != best.accuracy()) return candidate.accuracy() > best.accuracy();
  return candidate.meanLoss() < best.meanLoss();
}

void requireFinite(const LossSum& sum, const char* name, int epoch) {
  if (std::isfinite(sum.loss)) return;
  throw std::runtime_error(std::string("training diverged: the ") + name + " loss of epoch " + std::to_string(epoch) +
                           " is not finite; a lower learning rate or gradient norm helps");
}

/// nullptr before the first.
const EpochReport* bestOf(const std::vector<EpochReport>& curve) {
  const auto best = std::find_if(curve.rbegin(), curve.rend(), [](const EpochReport& report) { return report.best; });
  return best == curve.rend() ? nullptr : &*best;
}

/// Throws std::invalid_argument.
const LayerStack& checked(const LayerStack& layers, const std::vector<Sequence>& training,
                          const std::vector<Sequence>& validation, const TrainerParameters& parameters) {
  validate(parameters);
  validateLayers(layers);
  validateSequences(training, inputSize(layers), outputSize(layers), "training");
  validateSequences(validation, inputSize(layers), outputSize(layers), "validation");
  if (countWeighted(training) == 0) {
    throw std::invalid_argument("training set of " + std::to_string(training.size()) +
                                " sequences has no step with a weight above 0, expected at least one");
  }
  return layers;
}

}  // namespace

/// Loss of a batch, and its gradient where it is asked for, computed group by group and summed in the groups' order:
/// the sum does not depend on which thread did which group.
class GroupedGradient {
 public:
  GroupedGradient(const LayerStack& layers, Loss loss, int threads) {
    for (int thread = 0; thread < threads; ++thread) workers_.emplace_back(layers, loss);
  }

  LossSum loss(const Eigen::VectorXf& parameters, const Batch& batch, Eigen::VectorXf* gradient = nullptr) {
    if (batch.empty()) return {};
    const std::vector<Batch> groups = SequenceGradient::groupsOf(batch);
    std::vector<Eigen::VectorXf> gradients(groups.size());
    const auto work = [&](int group, int thread) {
      const auto index = static_cast<std::size_t>(group);
      SequenceGradient& worker = workers_[static_cast<std::size_t>(thread)];
      return worker.loss(parameters, groups[index], gradient != nullptr ? &gradients[index] : nullptr);
    };
    const LossSum sum =
        parallelSum(static_cast<int>(groups.size()), static_cast<int>(workers_.size()), LossSum(), work);
    if (gradient != nullptr) {
      gradient->setZero(parameters.size());
      for (const Eigen::VectorXf& of_group : gradients) *gradient += of_group;
    }
    return sum;
  }

 private:
  std::vector<SequenceGradient> workers_;
};

Trainer::Trainer(const LayerStack& layers, const std::vector<Sequence>& training,
                 const std::vector<Sequence>& validation, const TrainerParameters& parameters, TrainingState* state)
    : parameters_(parameters),
      layers_(checked(layers, training, validation, parameters)),
      state_(*state),
      gradient_(std::make_unique<GroupedGradient>(layers, parameters.loss, parameters.threads)),
      optimiser_(parameters.optimiser, weightMask(layers)),
      order_(pointersTo(training)),
      validation_(pointersTo(validation)),
      random_(parameters.seed),
      weights_(parameterVector(layers)) {
  if (averages()) averaged_weights_ = weights_;
  if (!state_.curve.empty()) goOn();
}

Trainer::~Trainer() = default;

const EpochReport& Trainer::runEpoch() {
  EpochReport report = learn(static_cast<int>(state_.curve.size()) + 1);
  const EpochReport* best = bestOf(state_.curve);
  report.best = best == nullptr || validation_.empty() || isBetter(report.kept(), best->kept());
  if (report.best) state_.best_weights = averages() ? averaged_weights_ : weights_;
  state_.weights = weights_;
  state_.averaged_weights = averaged_weights_;
  state_.optimiser = optimiser_.state();
  state_.curve.push_back(std::move(report));
  return state_.curve.back();
}

TrainingResult Trainer::result() const {
  const EpochReport* best = bestOf(state_.curve);
  if (best == nullptr) throw std::logic_error("a training has no result before its first epoch");
  TrainingResult result{layers_, best->epoch, state_.curve};
  setParameterVector(state_.best_weights, result.layers);
  return result;
}

void Trainer::goOn() {
  if (state_.weights.size() != weights_.size() || state_.best_weights.size() != weights_.size()) {
    throw std::invalid_argument("the training's state has " + std::to_string(state_.weights.size()) +
                                " weights, the layers have " + std::to_string(weights_.size()));
  }
  if (state_.averaged_weights.size() != averaged_weights_.size()) {
    throw std::invalid_argument("the training's state has " + std::to_string(state_.averaged_weights.size()) +
                                " averaged weights, expected " + std::to_string(averaged_weights_.size()));
  }
  weights_ = state_.weights;
  averaged_weights_ = state_.averaged_weights;
  optimiser_.setState(state_.optimiser);
  for (std::size_t epoch = 0; epoch < state_.curve.size(); ++epoch) shuffle(&order_, random_);
  update_ = static_cast<long>(state_.curve.size() * cut(order_, parameters_.batch_size).size());
}

EpochReport Trainer::learn(int epoch) {
  shuffle(&order_, random_);
  const std::vector<Batch> batches = cut(order_, parameters_.batch_size);
  const long updates = static_cast<long>(batches.size()) * parameters_.epochs;
  EpochReport report;
  report.epoch = epoch;
  Eigen::VectorXf gradient;
  for (const Batch& batch : batches) {
    const LossSum sum = gradient_->loss(weights_, batch, &gradient);
    requireFinite(sum, "training", epoch);
    const double progress = static_cast<double>(update_++) / static_cast<double>(updates);
    report.learning_rate = optimiser_.rate(progress);
    report.training += sum;
    report.mean_batch_accuracy += sum.accuracy() / static_cast<double>(batches.size());
    if (sum.weight <= 0.0) continue;
    gradient *= static_cast<float>(1.0 / sum.weight);
    optimiser_.update(gradient, progress, weights_);
    if (averages()) average();
  }
  report.validation = gradient_->loss(weights_, validation_);
  requireFinite(report.validation, "validation", epoch);
  if (averages()) report.averaged = gradient_->loss(averaged_weights_, validation_);
  return report;
}

void Trainer::average() {
  const double updates = static_cast<double>(optimiser_.state().updates);
  const double kept = std::min(parameters_.averaging, (1.0 + updates) / (10.0 + updates));
  averaged_weights_ += static_cast<float>(1.0 - kept) * (weights_ - averaged_weights_);
}

void validate(const TrainerParameters& parameters) {
  checkAtLeastOne("epochs", parameters.epochs);
  checkAtLeastOne("batch_size", parameters.batch_size);
  checkAtLeastOne("threads", parameters.threads);
  checkParameter(parameters.averaging >= 0.0 && parameters.averaging < 1.0, "averaging", parameters.averaging,
                 "a share in [0, 1)");
  validate(parameters.optimiser);
}

TrainingResult train(const LayerStack& layers, const std::vector<Sequence>& training,
                     const std::vector<Sequence>& validation, const TrainerParameters& parameters,
                     const EpochCallback& callback, TrainingState* state) {
  TrainingState begun_here;
  Trainer trainer(layers, training, validation, parameters, state != nullptr ? state : &begun_here);
  while (!trainer.done()) {
    const EpochReport& report = trainer.runEpoch();
    if (callback && !callback(report)) break;
  }
  return trainer.result();
}

LossSum evaluate(const LayerStack& layers, const std::vector<Sequence>& sequences, int threads) {
  checkAtLeastOne("threads", threads);
  validateLayers(layers);
  validateSequences(sequences, inputSize(layers), outputSize(layers), "evaluation");
  GroupedGradient gradient(layers, TrainerParameters{}.loss, threads);
  return gradient.loss(parameterVector(layers), pointersTo(sequences));
}

}  // namespace lstm_planner
