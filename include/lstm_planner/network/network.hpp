#pragma once

#include <vector>

#include <Eigen/Core>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// Runs a stack of layers one step at a time and carries its hidden state from step to step.
///
/// Batch 1, single precision; nothing is allocated after construction. The hidden state starts at zero and changes only
/// in forward(), reset() and setHiddenState(). Not thread safe: one network an agent.
class Network {
 public:
  /// Hidden and cell states of all recurrent layers, in one vector; for saving and restoring, not for reading.
  using HiddenState = Eigen::VectorXf;

  /// Throws std::invalid_argument when the layers do not fit together (validateLayers).
  explicit Network(LayerStack layers);

  /// One step. `input` has inputSize() values; the result has outputSize() values and stays valid until the next call.
  /// Throws std::invalid_argument for a wrong size or a non-finite input, before the hidden state has changed.
  const Eigen::VectorXf& forward(const Eigen::Ref<const Eigen::VectorXf>& input);

  /// Forgets everything: hidden and cell states become zero.
  void reset();

  const HiddenState& hiddenState() const { return hidden_state_; }

  /// Throws std::invalid_argument when the size is not hiddenState().size().
  void setHiddenState(const HiddenState& state);

  int inputSize() const { return input_size_; }
  int outputSize() const { return output_size_; }
  const LayerStack& layers() const { return layers_; }

 private:
  LayerStack layers_;
  int input_size_ = 0;
  int output_size_ = 0;
  HiddenState hidden_state_;
  std::vector<Eigen::VectorXf> gates_;    ///< scratch, one a layer
  std::vector<Eigen::VectorXf> outputs_;  ///< scratch, one a layer
};

}  // namespace lstm_planner
