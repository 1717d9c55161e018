#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "lstm_planner/network/instruction_set.hpp"
#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

struct CacheLine;
class PackedNetwork;

/// Runs a stack of layers one step at a time and carries the hidden state from step to step: of one sequence, or of
/// several that have the weights in common and do not depend on each other, such as the views of an agent.
///
/// Batch 1, single precision, within 1e-5 of double precision over a thousand steps. Nothing is allocated after
/// construction. Hidden states start at zero and change only in forward() and reset(). The same steps give the same
/// bits with the same instruction set. Copies share their weights; each has its own hidden states. Not thread safe: use
/// one for each agent.
///
/// Sequences are counted from 0. Functions throw std::out_of_range for one that does not exist.
class Network {
 public:
  /// One vector: for each recurrent layer its outputs, then the cell states if it is an LSTM.
  using HiddenState = Eigen::VectorXf;

  /// Throws std::invalid_argument if the layers do not fit together (validateLayers), if `set` is not one of
  /// runnableInstructionSets(), or if `sequences` is less than 1.
  explicit Network(const LayerStack& layers, InstructionSet set = fastestInstructionSet(), int sequences = 1);
  Network(const Network& other);
  Network(Network&&) noexcept;
  Network& operator=(const Network& other);
  Network& operator=(Network&&) noexcept;
  ~Network();

  /// One step of a sequence. `input` has inputSize() values. The result has outputSize() values and is valid until the
  /// next call, for any sequence.
  /// Throws std::invalid_argument for a wrong size, an input that is not finite, or one so large that a weighted sum
  /// exceeds the range of float; then the hidden state does not change. Sums beyond +-9 give the limits of the
  /// activations. Denormal numbers count as zero, as processors are slow with them; the floating-point mode of the
  /// caller does not change.
  const Eigen::VectorXf& forward(const Eigen::Ref<const Eigen::VectorXf>& input, int sequence = 0);

  /// Sets the hidden states and cell states of all sequences to zero.
  void reset();

  /// The state for the sequence's next step. Valid until forward() or reset() is called.
  Eigen::Map<const HiddenState> hiddenState(int sequence = 0) const;

  int sequences() const { return static_cast<int>(places_.size()) - 1; }
  int inputSize() const { return input_size_; }
  std::size_t weights() const { return weights_; }  ///< number of weights, with biases
  std::size_t stateBytes() const;                   ///< of all sequences: all that a copy does not share
  int outputSize() const { return static_cast<int>(output_.size()); }

 private:
  std::size_t placeOf(int sequence) const;
  const float* memory(std::size_t place) const;
  float* memory(std::size_t place);

  std::shared_ptr<const PackedNetwork> packed_;
  std::vector<CacheLine> memories_;  ///< one more than there are sequences: the next step's
  std::vector<std::size_t> places_;  ///< where each sequence's memory starts, in lines; the last one is the next step's
  int input_size_ = 0;
  std::size_t weights_ = 0;
  Eigen::VectorXf output_;
};

}  // namespace lstm_planner
