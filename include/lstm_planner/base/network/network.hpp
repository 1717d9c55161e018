#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lstm_planner/base/network/instruction_set.hpp"
#include "lstm_planner/base/network/layers.hpp"

namespace lstm_planner {

struct CacheLine;
class PackedNetwork;

/// Runs a stack of layers one step at a time and carries its hidden state from step to step.
///
/// Batch 1, single precision, within 1e-5 of double precision over a thousand steps; nothing is allocated after
/// construction. The hidden state starts at zero and changes only in forward(), reset() and setHiddenState(). The same
/// steps give the same bits as long as the instruction set is the same. Copies share their weights, and each has its
/// own hidden state. Not thread safe: one network an agent.
class Network {
 public:
  /// Outputs of all recurrent layers, each followed by an LSTM's cell states, in one vector.
  using HiddenState = Eigen::VectorXf;

  /// Throws std::invalid_argument when the layers do not fit together (validateLayers), or when `set` is not one of
  /// runnableInstructionSets().
  explicit Network(const LayerStack& layers, InstructionSet set = fastestInstructionSet());
  Network(const Network& other);
  Network(Network&&) noexcept;
  Network& operator=(const Network& other);
  Network& operator=(Network&&) noexcept;
  ~Network();

  /// One step. `input` has inputSize() values; the result has outputSize() values and stays valid until the next call.
  /// Throws std::invalid_argument for a wrong size, a non-finite input, or an input so large that a weighted sum leaves
  /// the range of float; the hidden state is then what it was before. Sums beyond +-9 give activations at their limits.
  /// Denormal numbers count as zero and none are made, as processors are slow with them; the caller's floating-point
  /// mode is left as it is.
  const Eigen::VectorXf& forward(const Eigen::Ref<const Eigen::VectorXf>& input);

  /// Forgets everything: hidden and cell states become zero.
  void reset();

  /// What forward() carries to its next call; valid until it, reset() or setHiddenState() is called.
  Eigen::Map<const HiddenState> hiddenState() const;

  /// Throws std::invalid_argument when the size is not hiddenState().size() or a value is not finite.
  void setHiddenState(const Eigen::Ref<const HiddenState>& state);

  int inputSize() const { return input_size_; }
  std::size_t weights() const { return weights_; }  ///< how many it has, biases counted
  int outputSize() const { return static_cast<int>(output_.size()); }

  /// What the kernels that run the network were compiled for.
  InstructionSet instructionSet() const { return instruction_set_; }

 private:
  const float* memory(std::size_t which) const;
  float* memory(std::size_t which);

  InstructionSet instruction_set_;
  std::shared_ptr<const PackedNetwork> packed_;
  std::vector<CacheLine> memories_;  ///< of the step before and of the one to come; which is which changes
  std::size_t now_ = 0;
  int input_size_ = 0;
  std::size_t weights_ = 0;
  Eigen::VectorXf output_;
};

}  // namespace lstm_planner
