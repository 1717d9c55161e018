#include "lstm_planner/training/trainer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner {
namespace {

using Batch = std::vector<const Sequence*>;

/// Loss and gradient of a batch, computed shard by shard and summed in the shards' order: the sum does not depend on
/// which thread of which rank did which shard.
class ShardedGradient {
 public:
  ShardedGradient(const LayerStack& layers, Loss loss, int shards, int threads, Communicator* ranks)
      : shards_(static_cast<std::size_t>(shards)),
        threads_(std::min(shards, threads)),
        ranks_(ranks),
        own_(shareOf(shards, ranks->rank(), ranks->size())),
        classes_(outputSize(layers)) {
    for (int thread = 0; thread < threads_; ++thread) workers_.emplace_back(layers, loss);
  }

  LossSum loss(const Eigen::VectorXf& parameters, const Batch& batch) { return evaluate(parameters, batch, nullptr); }

  LossSum lossAndGradient(const Eigen::VectorXf& parameters, const Batch& batch, Eigen::VectorXf& gradient) {
    return evaluate(parameters, batch, &gradient);
  }

 private:
  struct Shard {
    Batch batch;
    LossSum loss;
    Eigen::VectorXf gradient;
  };

  LossSum evaluate(const Eigen::VectorXf& parameters, const Batch& batch, Eigen::VectorXf* gradient) {
    deal(batch);
    parallelFor(own_.count(), threads_, [&](int index, int thread) {
      Shard& shard = shards_[static_cast<std::size_t>(own_.first + index)];
      auto& worker = workers_[static_cast<std::size_t>(thread)];
      shard.loss = gradient != nullptr ? worker.lossAndGradient(parameters, shard.batch, shard.gradient)
                                       : worker.loss(parameters, shard.batch);
    });
    if (ranks_->size() > 1) {
      exchangeLosses();
      if (gradient != nullptr) exchangeGradients(parameters.size());
    }
    LossSum sum;
    if (gradient != nullptr) gradient->setZero(parameters.size());
    for (const Shard& shard : shards_) {
      sum += shard.loss;
      if (gradient != nullptr) *gradient += shard.gradient;
    }
    return sum;
  }

  template <typename Scalar>
  void exchangeColumns(Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>* columns) {
    exchangeShares(ranks_, static_cast<int>(shards_.size()), static_cast<std::size_t>(columns->rows()),
                   columns->data());
  }

  void exchangeGradients(Eigen::Index parameters) {
    Eigen::MatrixXf columns(parameters, static_cast<Eigen::Index>(shards_.size()));
    for (int shard = own_.first; shard < own_.last; ++shard) columns.col(shard) = shardAt(shard).gradient;
    exchangeColumns(&columns);
    for (int shard = 0; shard < columns.cols(); ++shard) shardAt(shard).gradient = columns.col(shard);
  }

  void exchangeLosses() {
    // Counts are exact as double up to 2^53.
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(2 + classes_ * classes_, static_cast<Eigen::Index>(shards_.size()));
    const auto countsOf = [&](int shard) {
      return Eigen::Map<Eigen::MatrixXd>(columns.col(shard).data() + 2, classes_, classes_);
    };
    for (int shard = own_.first; shard < own_.last; ++shard) {
      const LossSum& loss = shardAt(shard).loss;
      columns.col(shard).head(2) << loss.loss, loss.weight;
      if (loss.confusion.size() > 0) countsOf(shard) = loss.confusion.cast<double>();
    }
    exchangeColumns(&columns);
    for (int shard = 0; shard < columns.cols(); ++shard) {
      LossSum& loss = shardAt(shard).loss;
      loss.loss = columns(0, shard);
      loss.weight = columns(1, shard);
      loss.confusion = countsOf(shard).cast<std::int64_t>();
    }
  }

  Shard& shardAt(int index) { return shards_[static_cast<std::size_t>(index)]; }

  /// Like cards, the longest sequences first, so that all shards have about as much to do.
  void deal(Batch batch) {
    std::stable_sort(batch.begin(), batch.end(),
                     [](const Sequence* a, const Sequence* b) { return a->steps() > b->steps(); });
    for (Shard& shard : shards_) shard.batch.clear();
    for (std::size_t index = 0; index < batch.size(); ++index) {
      shards_[index % shards_.size()].batch.push_back(batch[index]);
    }
  }

  std::vector<Shard> shards_;
  int threads_;
  Communicator* ranks_;
  Share own_;  ///< the shards that this rank does
  Eigen::Index classes_;
  std::vector<SequenceGradient<float>> workers_;
};

void requireAtLeastOne(const char* name, int value) {
  if (value >= 1) return;
  throw std::invalid_argument(std::string("trainer parameter ") + name + " is " + std::to_string(value) +
                              ", expected at least 1");
}

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

LossSum sumOfLosses(const Eigen::VectorXf& parameters, const std::vector<Batch>& batches, ShardedGradient& gradient) {
  LossSum sum;
  for (const Batch& batch : batches) sum += gradient.loss(parameters, batch);
  return sum;
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

bool hasWeight(const std::vector<Sequence>& sequences) {
  return std::any_of(sequences.begin(), sequences.end(),
                     [](const Sequence& sequence) { return (sequence.weights.array() > 0.0f).any(); });
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
  if (!hasWeight(training)) {
    throw std::invalid_argument("training set of " + std::to_string(training.size()) +
                                " sequences has no step with a weight above 0, expected at least one");
  }
  return layers;
}

}  // namespace

class Trainer::Implementation {
 public:
  Implementation(const LayerStack& layers, const std::vector<Sequence>& training,
                 const std::vector<Sequence>& validation, const TrainerParameters& parameters, TrainingState* state)
      : parameters_(parameters),
        layers_(checked(layers, training, validation, parameters)),
        state_(*state),
        gradient_(layers, parameters.loss, parameters.shards, parameters.threads, parameters.communicator),
        optimiser_(parameters.optimiser, weightMask(layers)),
        order_(pointersTo(training)),
        validation_(cut(pointersTo(validation), parameters.batch_size)),
        random_(parameters.seed),
        weights_(parameterVector(layers)) {
    if (averages()) averaged_weights_ = weights_;
    if (!state_.curve.empty()) goOnFrom(state_);
  }

  bool done() const { return static_cast<int>(state_.curve.size()) >= parameters_.epochs; }

  const EpochReport& runEpoch() {
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

  TrainingResult result() const {
    const EpochReport* best = bestOf(state_.curve);
    if (best == nullptr) throw std::logic_error("a training has no result before its first epoch");
    TrainingResult result{layers_, best->epoch, state_.curve};
    setParameterVector(state_.best_weights, result.layers);
    return result;
  }

 private:
  bool averages() const { return parameters_.averaging > 0.0; }

  void goOnFrom(const TrainingState& state) {
    if (state.weights.size() != weights_.size() || state.best_weights.size() != weights_.size()) {
      throw std::invalid_argument("the training's state has " + std::to_string(state.weights.size()) +
                                  " weights, the layers have " + std::to_string(weights_.size()));
    }
    if (state.averaged_weights.size() != averaged_weights_.size()) {
      throw std::invalid_argument("the training's state has " + std::to_string(state.averaged_weights.size()) +
                                  " averaged weights, expected " + std::to_string(averaged_weights_.size()));
    }
    weights_ = state.weights;
    averaged_weights_ = state.averaged_weights;
    optimiser_.setState(state.optimiser);
    for (std::size_t epoch = 0; epoch < state.curve.size(); ++epoch) shuffle(&order_, random_);
    update_ = static_cast<long>(state.curve.size() * cut(order_, parameters_.batch_size).size());
  }

  EpochReport learn(int epoch) {
    shuffle(&order_, random_);
    const std::vector<Batch> batches = cut(order_, parameters_.batch_size);
    const long updates = static_cast<long>(batches.size()) * parameters_.epochs;
    EpochReport report;
    report.epoch = epoch;
    for (const Batch& batch : batches) {
      const LossSum sum = gradient_.lossAndGradient(weights_, batch, mean_gradient_);
      requireFinite(sum, "training", epoch);
      report.learning_rate = learningRate(parameters_.optimiser, update_++, updates);
      report.training += sum;
      report.mean_batch_accuracy += sum.accuracy() / static_cast<double>(batches.size());
      if (sum.weight <= 0.0) continue;
      mean_gradient_ *= static_cast<float>(1.0 / sum.weight);
      optimiser_.update(mean_gradient_, report.learning_rate, weights_);
      if (averages()) average();
    }
    report.validation = sumOfLosses(weights_, validation_, gradient_);
    requireFinite(report.validation, "validation", epoch);
    if (averages()) report.averaged = sumOfLosses(averaged_weights_, validation_, gradient_);
    return report;
  }

  void average() {
    const double updates = static_cast<double>(optimiser_.state().updates);
    const double kept = std::min(parameters_.averaging, (1.0 + updates) / (10.0 + updates));
    averaged_weights_ += static_cast<float>(1.0 - kept) * (weights_ - averaged_weights_);
  }

  const TrainerParameters parameters_;
  const LayerStack layers_;
  TrainingState& state_;
  ShardedGradient gradient_;
  Optimiser optimiser_;
  Batch order_;
  std::vector<Batch> validation_;
  Random random_;
  Eigen::VectorXf weights_;
  Eigen::VectorXf averaged_weights_;  ///< empty without averaging
  Eigen::VectorXf mean_gradient_;
  long update_ = 0;
};

Trainer::Trainer(const LayerStack& layers, const std::vector<Sequence>& training,
                 const std::vector<Sequence>& validation, const TrainerParameters& parameters, TrainingState* state)
    : implementation_(std::make_unique<Implementation>(layers, training, validation, parameters, state)) {}
Trainer::~Trainer() = default;
bool Trainer::done() const { return implementation_->done(); }
const EpochReport& Trainer::runEpoch() { return implementation_->runEpoch(); }
TrainingResult Trainer::result() const { return implementation_->result(); }

void validate(const TrainerParameters& parameters) {
  requireAtLeastOne("epochs", parameters.epochs);
  requireAtLeastOne("batch_size", parameters.batch_size);
  requireAtLeastOne("shards", parameters.shards);
  requireAtLeastOne("threads", parameters.threads);
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
  requireAtLeastOne("threads", threads);
  validateLayers(layers);
  validateSequences(sequences, inputSize(layers), outputSize(layers), "evaluation");
  const TrainerParameters defaults;
  ShardedGradient gradient(layers, defaults.loss, defaults.shards, threads, oneProcess());
  return sumOfLosses(parameterVector(layers), cut(pointersTo(sequences), defaults.batch_size), gradient);
}

}  // namespace lstm_planner
