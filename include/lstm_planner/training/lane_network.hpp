#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

class LaneLayer;

/// A network over many lanes at once, step by step forward through a window of time and back through it. A lane is a
/// known sequence (SequenceGradient), or an agent whose next input depends on the last output (reinforcement learning).
/// A value is a row with a number for each lane.
///
/// It has no softmax. The hidden state is carried from window to window; errors go back to the window's first step
/// (truncated back-propagation).
class LaneNetwork {
 public:
  /// `lanes` is a multiple of 16, `steps` the window's length. Throws std::invalid_argument for a softmax, for another
  /// number of lanes, and for fewer than one step.
  LaneNetwork(const LayerStack& layers, int lanes, int steps);
  LaneNetwork(LaneNetwork&&) noexcept;
  LaneNetwork& operator=(LaneNetwork&&) noexcept;
  ~LaneNetwork();

  int lanes() const { return lanes_; }
  int inputSize() const { return input_size_; }
  int outputSize() const { return output_size_; }

  /// The inputSize() rows that forward(step) reads, to be filled by the caller.
  float* inputs(int step) { return inputs_.data() + offset(step, input_size_); }

  /// Runs one step. `parameters` are ordered as in parameterVector(). The result is outputSize() rows.
  const float* forward(const Eigen::VectorXf& parameters, int step);

  /// The result of forward(step).
  const float* outputs(int step) const;

  /// The hidden state of one lane becomes zero at the start of `step`, as at the start of an episode; errors do not go
  /// back beyond it. To be called before forward(step).
  void forget(int step, int lane);

  /// The hidden state before step 0 becomes zero in every lane.
  void reset();

  /// The state after step `steps - 1` becomes that before step 0, for the next window.
  void carryOver(int steps);

  /// The outputSize() rows of the error's derivative by the outputs, to be filled before backward().
  float* outputGradient(int step) { return output_gradient_.data() + offset(step, output_size_); }

  /// Adds the error's derivative by the parameters for the first `steps` steps to `gradient`. Overwrites what forward()
  /// has stored.
  void backward(const Eigen::VectorXf& parameters, int steps, Eigen::VectorXf& gradient);

 private:
  std::size_t offset(int step, int size) const {
    return static_cast<std::size_t>(step) * static_cast<std::size_t>(size) * static_cast<std::size_t>(lanes_);
  }

  int lanes_ = 0;
  int input_size_ = 0;
  int output_size_ = 0;
  std::vector<std::unique_ptr<LaneLayer>> layers_;
  std::vector<float> inputs_;
  std::vector<float> output_gradient_;
};

}  // namespace lstm_planner
