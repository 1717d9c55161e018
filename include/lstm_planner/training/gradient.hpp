#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/network/layers.hpp"
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
/// the end is the same softmax and not applied twice. Its derivative by the preference k is weight * (probability_k -
/// target_k), so that a linear last layer with inputs z gets the gradient sum_n (phi_nk - t_nk) z_n; thesis Eq. 2.32
/// prints phi_n for z_n. With the Euclidean loss the preferences y take the place of the probabilities (Eq. 2.7, 2.10),
/// and there is no softmax. Errors go back to the first step of every sequence.
///
/// An object holds the layers' shapes and the memory for one batch at a time: one object a thread.
/// Scalar is float for training and double for checking the gradient.
template <typename Scalar>
class SequenceGradient {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  /// Throws std::invalid_argument when the layers do not fit together, a softmax is not the last layer, or there is one
  /// and the loss is Euclidean.
  explicit SequenceGradient(const LayerStack& layers, Loss loss = Loss::kCrossEntropy);
  SequenceGradient(SequenceGradient&&) noexcept;
  SequenceGradient& operator=(SequenceGradient&&) noexcept;
  ~SequenceGradient();

  /// Number of parameters, ordered as in parameterVector().
  Eigen::Index parameterCount() const;

  /// Loss with the given parameters, forward only.
  LossSum loss(const Vector& parameters, const std::vector<const Sequence*>& batch);

  /// The same, and the gradient of LossSum::loss (a sum, not a mean) in `gradient`.
  /// Sequences must be valid (validateSequences); a wrong number of parameters throws std::invalid_argument.
  LossSum lossAndGradient(const Vector& parameters, const std::vector<const Sequence*>& batch, Vector& gradient);

  /// Preferences before the softmax, outputs x steps, for one sequence.
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> preferences(const Vector& parameters, const Sequence& sequence);

  /// Derivative by the inputs, inputs x steps, of the sum of the preferences times `factors` (outputs x steps), for one
  /// sequence, whose labels are not looked at. Throws std::invalid_argument for factors of another size.
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> inputGradient(
      const Vector& parameters, const Sequence& sequence,
      const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& factors);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

extern template class SequenceGradient<float>;
extern template class SequenceGradient<double>;

}  // namespace lstm_planner
