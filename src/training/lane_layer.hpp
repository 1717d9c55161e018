#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "training/lane_kernels.hpp"

namespace lstm_planner {

/// A layer with what it computed in each step of the window.
class LaneLayer {
 public:
  LaneLayer(int inputs, int units, int outputs, int lanes, int steps)
      : inputs_(inputs),
        units_(units),
        outputs_(outputs),
        lanes_(lanes),
        sums_(static_cast<std::size_t>(units) * static_cast<std::size_t>(lanes * steps)),
        results_(static_cast<std::size_t>(outputs) * static_cast<std::size_t>(lanes * steps)),
        result_gradients_(static_cast<std::size_t>(outputs * lanes)) {}
  virtual ~LaneLayer() = default;

  virtual int parameterCount() const { return units_ * inputs_ + units_; }
  virtual void forward(const float* parameters, int step, const float* inputs) = 0;
  /// From resultGradient() to the gradient by the weighted sums, which stays for addGradient().
  virtual void backward(const float* parameters, int step) = 0;
  virtual void startBackward() {}
  virtual void addGradient(const float* inputs, int steps, float* gradient) const {
    laneKernels().accumulateWeightGradient(sums(0), inputs, units_, inputs_, steps, gradient, lanes_);
    laneKernels().accumulateBiasGradient(sums(0), units_, steps, gradient + units_ * inputs_, lanes_);
  }
  virtual void forget(int /*step*/, int /*lane*/) {}
  virtual void reset() {}
  virtual void carryOver(int /*steps*/) {}

  const float* results(int step) const { return results_.data() + at(step, outputs_); }
  float* resultGradient() { return result_gradients_.data(); }

  /// inputs_gradient = transposed input weights * gradient by the weighted sums.
  void inputGradient(const float* parameters, int step, float* gradient) const {
    std::fill_n(gradient, inputs_ * lanes_, 0.0f);
    laneKernels().accumulateProduct(parameters, units_, 1, inputs_, units_, sums(step), gradient, lanes_);
  }

 protected:
  std::size_t at(int step, int rows) const {
    return static_cast<std::size_t>(step) * static_cast<std::size_t>(rows * lanes_);
  }
  float* sums(int step) { return sums_.data() + at(step, units_); }
  const float* sums(int step) const { return sums_.data() + at(step, units_); }
  float* results(int step) { return results_.data() + at(step, outputs_); }

  void weigh(const float* weights, const float* bias, int step, const float* inputs) {
    for (int unit = 0; unit < units_; ++unit) std::fill_n(sums(step) + unit * lanes_, lanes_, bias[unit]);
    laneKernels().accumulateProduct(weights, 1, units_, units_, inputs_, inputs, sums(step), lanes_);
  }

  int inputs_;
  int units_;
  int outputs_;
  int lanes_;

 private:
  std::vector<float> sums_;  ///< weighted sums or activations, after backward() gradients by the weighted sums
  std::vector<float> results_;
  std::vector<float> result_gradients_;  ///< of the step that backward() is at
};

/// Throws std::invalid_argument for a layer of another kind than LaneNetwork has.
std::unique_ptr<LaneLayer> makeLaneLayer(const Layer& layer, int lanes, int steps);

}  // namespace lstm_planner
