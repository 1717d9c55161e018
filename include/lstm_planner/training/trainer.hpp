#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/optimiser.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// How a network learns from sequences.
struct TrainerParameters {
  int epochs = 20;         ///< passes over the training set, >= 1
  int batch_size = 128;    ///< sequences per update, >= 1; with a recurrent layer one takes as long as 16
  int threads = 2;         ///< >= 1; they share the groups of a batch (SequenceGradient); does not change the result
  std::uint64_t seed = 1;  ///< of the order of the sequences
  OptimiserParameters optimiser;
  Loss loss = Loss::kCrossEntropy;  ///< what is minimised, and reported

  /// In [0, 1); 0: no average. After each update the average is this share of the old average plus the rest of the new
  /// weights (Polyak and Juditsky, "Acceleration of stochastic approximation by averaging", 1992, in its exponential
  /// form). The share is at most (1 + updates) / (10 + updates). The average has no effect on the training, but it is
  /// what is kept.
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
  bool best = false;           ///< better on the validation set than all earlier epochs
  LossSum averaged = {};       ///< `validation` of the averaged weights; empty when there are none

  /// Mean over the batches of the accuracy before the batch's update: the thesis's accuracy of an epoch (Eq. 4.5). It
  /// is not the accuracy of any one set of weights.
  double mean_batch_accuracy = 0.0;

  /// On the validation set, of the weights that are kept if this epoch is the best one.
  const LossSum& kept() const { return averaged.confusion.size() > 0 ? averaged : validation; }
};

/// Result of a training.
struct TrainingResult {
  LayerStack layers;  ///< of the best epoch
  int best_epoch = 0;
  std::vector<EpochReport> curve;

  const EpochReport& best() const { return curve[static_cast<std::size_t>(best_epoch - 1)]; }
};

/// A training between two epochs: what the next epochs depend on besides the arguments.
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
/// The epoch with the highest accuracy on the validation set is kept, of equal ones that with the lower loss; without a
/// validation set the last epoch. With averaging, the averaged weights are compared and kept. The same input gives the
/// same weights, bit for bit, for any number of threads. If `state` is that of a started training, it is continued as
/// if there had been no break. `state` is updated after each epoch.
class Trainer {
 public:
  /// Sequences and state must outlive the trainer. Throws std::invalid_argument for parameters, layers or sequences
  /// that are not valid, if no training step has a weight, and for the state of another network.
  Trainer(const LayerStack& layers, const std::vector<Sequence>& training, const std::vector<Sequence>& validation,
          const TrainerParameters& parameters, TrainingState* state);
  ~Trainer();

  bool done() const { return static_cast<int>(state_.curve.size()) >= parameters_.epochs; }
  /// Throws std::runtime_error if the loss is not finite any more.
  const EpochReport& runEpoch();
  /// Of the epochs so far; there must be at least one.
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

/// Called after each epoch; if it returns false, training ends early.
using EpochCallback = std::function<bool(const EpochReport&)>;

/// All epochs of a Trainer. `state`, if given, is updated before the callback.
TrainingResult train(const LayerStack& layers, const std::vector<Sequence>& training,
                     const std::vector<Sequence>& validation, const TrainerParameters& parameters,
                     const EpochCallback& callback = {}, TrainingState* state = nullptr);

/// Loss, accuracy and confusion counts of a stack over sequences. Throws as train().
LossSum evaluate(const LayerStack& layers, const std::vector<Sequence>& sequences, int threads = 1);

}  // namespace lstm_planner
