#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/lane_network.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// How often a label (row) was answered with a class (column).
using ConfusionMatrix = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic>;

/// What a step's error is.
enum class Loss {
  kCrossEntropy,  ///< -ln(probability of the label), thesis Eq. 2.31
  kEuclidean,     ///< half the squared distance of the preferences to 1 for the label and 0 for the others, Eq. 2.6
};

/// Errors and answers, summed over the steps whose weight is not 0.
struct LossSum {
  double loss = 0.0;          ///< sum of weight * error
  double weight = 0.0;        ///< sum of the weights
  ConfusionMatrix confusion;  ///< steps, not weighted

  LossSum& operator+=(const LossSum& other);

  double meanLoss() const;  ///< 0 when nothing was summed
  double accuracy() const;  ///< share of right answers (thesis Eq. 3.5-3.6), in [0, 1]; 0 when nothing was summed
};

/// Loss of a stack over many sequences at once, and its gradient by back-propagation through time (thesis
/// Eq. 2.17-2.19).
///
/// The error of a sequence's step is the cross-entropy of the softmax of the last layer's outputs; a SoftmaxLayer at
/// the end is this softmax, which is not applied twice. Its derivative by the preference k is weight * (probability_k -
/// target_k), so that a linear last layer with inputs z gets the gradient sum_n (phi_nk - t_nk) z_n; thesis Eq. 2.32
/// prints phi_n for z_n. With the Euclidean loss the preferences y take the place of the probabilities (Eq. 2.7, 2.10),
/// and there is no softmax. Errors go back to the first step of every sequence.
///
/// The sequences are the lanes of a LaneNetwork, kTogether at a time, the longest first; short ones wait for the
/// longest of their group. Without a recurrent layer a sequence may be cut into several lanes. An object holds the
/// memory for one group: one object a thread.
class SequenceGradient {
 public:
  using Batch = std::vector<const Sequence*>;

  /// Sequences that are computed side by side.
  static constexpr int kTogether = 16;

  /// Throws std::invalid_argument if the layers do not fit together, if a softmax is not the last layer, or if there is
  /// one and the loss is Euclidean.
  explicit SequenceGradient(const LayerStack& layers, Loss loss = Loss::kCrossEntropy);

  /// Divides a batch into groups of at most kTogether sequences of similar length.
  static std::vector<Batch> groupsOf(Batch batch);

  /// Loss with the given parameters, ordered as in parameterVector(). Writes the gradient of LossSum::loss (a sum, not
  /// a mean) to `gradient`, if it is given. Sequences must be valid (validateSequences()). Throws std::invalid_argument
  /// for a wrong number of parameters.
  LossSum loss(const Eigen::VectorXf& parameters, const Batch& batch, Eigen::VectorXf* gradient = nullptr);

 private:
  using Rows = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// What a lane computes.
  struct Piece {
    const Sequence* sequence;
    Eigen::Index first;  ///< step
    Eigen::Index steps;
  };

  std::vector<Piece> lanesOf(const Batch& group) const;
  void start(const Eigen::VectorXf& parameters, const std::vector<Piece>& lanes);
  Eigen::Map<const Rows> forward(const Eigen::VectorXf& parameters, Eigen::Index step);
  float weightOf(Eigen::Index lane, Eigen::Index step) const;
  Eigen::Index labelOf(Eigen::Index lane, Eigen::Index step) const;
  void addLoss(const Eigen::Map<const Rows>& preferences, Eigen::Index step, LossSum* sum);

  LayerStack layers_;  ///< without the softmax
  Loss loss_;
  Eigen::Index parameter_count_;
  Eigen::Index longest_;  ///< steps for which there is room in network_
  LaneNetwork network_;
  std::vector<Piece> lanes_;                        ///< the longest first
  Eigen::Array<float, 1, Eigen::Dynamic> largest_;  ///< preference of a lane
  Eigen::Array<float, 1, Eigen::Dynamic> total_;
};

}  // namespace lstm_planner
