#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "lstm_planner/common/communicator.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/optimiser.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// How a network learns from sequences.
struct TrainerParameters {
  int epochs = 20;       ///< passes over the training set, >= 1
  int batch_size = 128;  ///< sequences an update, >= 1; with memory one takes as long as 16
  int threads = 2;       ///< >= 1; each has groups of a batch (SequenceGradient); does not change the result
  Communicator* communicator = oneProcess();  ///< ranks that share the groups; does not change the result
  std::uint64_t seed = 1;                     ///< of the order of the sequences
  OptimiserParameters optimiser;
  Loss loss = Loss::kCrossEntropy;  ///< that is made small; also of the reports

  /// In [0, 1): share of the averaged weights that an update leaves; the rest is the weights after it (Polyak and
  /// Juditsky, "Acceleration of stochastic approximation by averaging", 1992, in its exponential form). The average
  /// takes no part in the training, but it is what is kept. Less while there are few updates: at most
  /// (1 + updates) / (10 + updates). 0: no average.
  double averaging = 0.0;
};

/// Throws std::invalid_argument with one sentence naming the parameter, its value and its range.
void validate(const TrainerParameters& parameters);

/// One point of the learning curve.
struct EpochReport {
  int epoch = 0;               ///< from 1
  double learning_rate = 0.0;  ///< of its last update
  LossSum training;            ///< while the weights were moving: each batch before its own update
  LossSum validation;          ///< after the epoch; empty without a validation set
  bool best = false;           ///< better on the validation set than all before
  LossSum averaged = {};       ///< `validation` of the averaged weights; empty when there are none

  /// Mean over the batches of each one's accuracy before its update, what the thesis calls the accuracy of an epoch
  /// (Eq. 4.5). No weights ever had it.
  double mean_batch_accuracy = 0.0;

  /// On the validation set, of the weights that are kept from this epoch if any are.
  const LossSum& kept() const { return averaged.confusion.size() > 0 ? averaged : validation; }
};

/// What a training brought.
struct TrainingResult {
  LayerStack layers;  ///< of the best epoch
  int best_epoch = 0;
  std::vector<EpochReport> curve;

  const EpochReport& best() const { return curve[static_cast<std::size_t>(best_epoch - 1)]; }
};

/// A training between two epochs: what the epochs to come depend on besides the arguments.
struct TrainingState {
  Eigen::VectorXf weights;
  Optimiser::State optimiser;
  Eigen::VectorXf averaged_weights;  ///< empty without averaging
  Eigen::VectorXf best_weights;
  std::vector<EpochReport> curve;  ///< of the epochs that are done; empty: not started
};

class GroupedGradient;

/// Supervised learning by mini-batches, epoch by epoch, starting from the weights of `layers`.
///
/// The epoch with the highest accuracy on the validation set is kept, of equals the one with the lower loss; without a
/// validation set the last. With averaging that means the averaged weights: theirs is the accuracy that is compared.
/// The same input gives the same weights, bit for bit, for any number of threads and ranks; of several ranks each has
/// to call it. A `state` that has been started is gone on with as if there had been no break; it is kept up to date.
class Trainer {
 public:
  /// Sequences and state must outlive it. Throws std::invalid_argument for parameters, layers or sequences that are not
  /// valid, when no training step has a weight, and for the state of another network.
  Trainer(const LayerStack& layers, const std::vector<Sequence>& training, const std::vector<Sequence>& validation,
          const TrainerParameters& parameters, TrainingState* state);
  ~Trainer();

  bool done() const { return static_cast<int>(state_.curve.size()) >= parameters_.epochs; }
  /// Throws std::runtime_error when the loss stops being finite.
  const EpochReport& runEpoch();
  /// Of the epochs so far, of which there must be one.
  TrainingResult result() const;

 private:
  bool averages() const { return parameters_.averaging > 0.0; }
  void goOn();
  EpochReport learn(int epoch);
  void average();

  const TrainerParameters parameters_;
  const LayerStack layers_;
  TrainingState& state_;
  std::unique_ptr<GroupedGradient> gradient_;
  Optimiser optimiser_;
  SequenceGradient::Batch order_;
  SequenceGradient::Batch validation_;
  Random random_;
  Eigen::VectorXf weights_;
  Eigen::VectorXf averaged_weights_;  ///< empty without averaging
  long update_ = 0;
};

/// Called after each epoch; training ends early when it returns false.
using EpochCallback = std::function<bool(const EpochReport&)>;

/// All epochs of a Trainer. The ranks' callbacks have to answer alike; `state`, where given, is up to date before each.
TrainingResult train(const LayerStack& layers, const std::vector<Sequence>& training,
                     const std::vector<Sequence>& validation, const TrainerParameters& parameters,
                     const EpochCallback& callback = {}, TrainingState* state = nullptr);

/// Loss, accuracy and confusion counts of a stack over sequences. Throws as train().
LossSum evaluate(const LayerStack& layers, const std::vector<Sequence>& sequences, int threads = 1);

}  // namespace lstm_planner
