#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lstm_planner/network/instruction_set.hpp"
#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

struct CacheLine;
class PackedNetwork;

/// Runs a stack of layers one step at a time and carries the hidden state from step to step.
///
/// Batch 1, single precision, within 1e-5 of double precision over a thousand steps. Nothing is allocated after
/// construction. The hidden state starts at zero and changes only in forward(), reset() and setHiddenState(). The same
/// steps give the same bits with the same instruction set. Copies share their weights; each has its own hidden state.
/// Not thread safe: use one for each agent.
class Network {
 public:
  /// One vector: for each recurrent layer its outputs, then the cell states if it is an LSTM.
  using HiddenState = Eigen::VectorXf;

  /// Throws std::invalid_argument if the layers do not fit together (validateLayers), or if `set` is not one of
  /// runnableInstructionSets().
  explicit Network(const LayerStack& layers, InstructionSet set = fastestInstructionSet());
  Network(const Network& other);
  Network(Network&&) noexcept;
  Network& operator=(const Network& other);
  Network& operator=(Network&&) noexcept;
  ~Network();

  /// One step. `input` has inputSize() values. The result has outputSize() values and is valid until the next call.
  /// Throws std::invalid_argument for a wrong size, an input that is not finite, or one so large that a weighted sum
  /// exceeds the range of float; then the hidden state does not change. Sums beyond +-9 give the limits of the
  /// activations. Denormal numbers count as zero, as processors are slow with them; the floating-point mode of the
  /// caller does not change.
  const Eigen::VectorXf& forward(const Eigen::Ref<const Eigen::VectorXf>& input);

  /// Sets hidden states and cell states to zero.
  void reset();

  /// The state for the next call of forward(). Valid until forward(), reset() or setHiddenState() is called.
  Eigen::Map<const HiddenState> hiddenState() const;

  /// Throws std::invalid_argument if the size is not hiddenState().size() or a value is not finite.
  void setHiddenState(const Eigen::Ref<const HiddenState>& state);

  int inputSize() const { return input_size_; }
  std::size_t weights() const { return weights_; }  ///< number of weights, with biases
  int outputSize() const { return static_cast<int>(output_.size()); }

  /// The instruction set of the kernels that run the network.
  InstructionSet instructionSet() const { return instruction_set_; }

 private:
  const float* memory(std::size_t which) const;
  float* memory(std::size_t which);

  InstructionSet instruction_set_;
  std::shared_ptr<const PackedNetwork> packed_;
  std::vector<CacheLine> memories_;  ///< of the last and of the next step, in turn
  std::size_t now_ = 0;
  int input_size_ = 0;
  std::size_t weights_ = 0;
  Eigen::VectorXf output_;
};

}  // namespace lstm_planner
