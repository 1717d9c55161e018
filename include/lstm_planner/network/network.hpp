#pragma once

#include <Eigen/Core>
#include <vector>

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
  /// Throws std::invalid_argument for a wrong size, a non-finite input, or an input so large that a weighted sum leaves
  /// the range of float; the hidden state is then what it was before.
  const Eigen::VectorXf& forward(const Eigen::Ref<const Eigen::VectorXf>& input);

  /// Forgets everything: hidden and cell states become zero.
  void reset();

  const HiddenState& hiddenState() const { return hidden_state_; }

  /// Throws std::invalid_argument when the size is not hiddenState().size() or a value is not finite.
  void setHiddenState(const HiddenState& state);

  int inputSize() const { return input_size_; }
  int outputSize() const { return output_size_; }
  const LayerStack& layers() const { return layers_; }

 private:
  /// Where a layer keeps what it computes.
  struct Workspace {
    Eigen::Index state_offset;      ///< of the layer's part of the hidden state: outputs, then an LSTM's cell states
    Eigen::Index state_size;        ///< 0 for a layer that remembers nothing
    Eigen::VectorXf weighted_sums;  ///< of the gates or units, before and after their activation
    Eigen::VectorXf output;
  };

  LayerStack layers_;
  int input_size_ = 0;
  int output_size_ = 0;
  std::vector<Workspace> workspaces_;  ///< one a layer
  HiddenState hidden_state_;
  HiddenState next_hidden_state_;  ///< becomes hidden_state_ when all layers have succeeded
};

}  // namespace lstm_planner
