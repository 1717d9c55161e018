#include "training/lane_layer.hpp"

#include <stdexcept>

namespace lstm_planner {
namespace {

void activate(Activation activation, float* values, int count) {
  const auto halve = [&](float offset) {
    for (int i = 0; i < count; ++i) values[i] = 0.5f * values[i] + offset;
  };
  switch (activation) {
    case Activation::kIdentity:
      return;
    case Activation::kTanh:
      return laneKernels().applyTanh(values, count);
    case Activation::kSigmoid:  // by way of tanh
      halve(0.0f);
      laneKernels().applyTanh(values, count);
      return halve(0.5f);
    case Activation::kRelu:
      for (int i = 0; i < count; ++i) values[i] = std::max(values[i], 0.0f);
      return;
  }
}

/// Multiplies `gradient` by the activation's derivative, written in terms of its result.
void multiplyByDerivative(Activation activation, const float* results, float* gradient, int count) {
  switch (activation) {
    case Activation::kIdentity:
      return;
    case Activation::kTanh:
      return laneKernels().multiplyByTanhDerivative(results, gradient, count);
    case Activation::kSigmoid:
      for (int i = 0; i < count; ++i) gradient[i] *= results[i] * (1.0f - results[i]);
      return;
    case Activation::kRelu:
      for (int i = 0; i < count; ++i) gradient[i] = results[i] > 0.0f ? gradient[i] : 0.0f;
      return;
  }
}

class DenseLanes : public LaneLayer {
 public:
  DenseLanes(const DenseLayer& layer, int lanes, int steps)
      : LaneLayer(static_cast<int>(layer.weights.cols()), static_cast<int>(layer.weights.rows()),
                  static_cast<int>(layer.weights.rows()), lanes, steps),
        activation_(layer.activation) {}

  void forward(const float* parameters, int step, const float* inputs) override {
    weigh(parameters, parameters + units_ * inputs_, step, inputs);
    std::copy_n(sums(step), units_ * lanes_, LaneLayer::results(step));
    activate(activation_, LaneLayer::results(step), units_ * lanes_);
  }

  void backward(const float* /*parameters*/, int step) override {
    std::copy_n(resultGradient(), units_ * lanes_, sums(step));
    multiplyByDerivative(activation_, results(step), sums(step), units_ * lanes_);
  }

 private:
  Activation activation_;
};

/// What the two recurrent kinds share: their state before each step, and how errors go from step to step.
class RecurrentLanes : public LaneLayer {
 public:
  RecurrentLanes(int inputs, int units, int cells, int lanes, int steps)
      : LaneLayer(inputs, units, cells, lanes, steps),
        previous_outputs_(static_cast<std::size_t>(cells) * static_cast<std::size_t>(lanes * (steps + 1))),
        carried_gradient_(static_cast<std::size_t>(cells * lanes)) {}

  int parameterCount() const override { return LaneLayer::parameterCount() + units_ * outputs_; }

  void forward(const float* parameters, int step, const float* inputs) override {
    weigh(parameters, parameters + biasOffset(), step, inputs);
    laneKernels().accumulateProduct(recurrentWeights(parameters), 1, units_, units_, outputs_, previousOutputs(step),
                                    sums(step), lanes_);
    activate(step);
    std::copy_n(results(step), outputs_ * lanes_, previousOutputs(step + 1));
  }

  void startBackward() override { std::fill(carried_gradient_.begin(), carried_gradient_.end(), 0.0f); }

  void backward(const float* parameters, int step) override {
    float* gradient = resultGradient();
    for (int i = 0; i < outputs_ * lanes_; ++i) gradient[i] += carried_gradient_[static_cast<std::size_t>(i)];
    activateBackward(step, gradient);
    std::fill(carried_gradient_.begin(), carried_gradient_.end(), 0.0f);
    laneKernels().accumulateProduct(recurrentWeights(parameters), units_, 1, outputs_, units_, sums(step),
                                    carried_gradient_.data(), lanes_);
    for (const Forgotten& forgotten : forgotten_) {
      if (forgotten.step == step) clearLane(forgotten.lane, carried_gradient_.data());
    }
  }

  void addGradient(const float* inputs, int steps, float* gradient) const override {
    laneKernels().accumulateWeightGradient(sums(0), inputs, units_, inputs_, steps, gradient, lanes_);
    laneKernels().accumulateWeightGradient(sums(0), previous_outputs_.data(), units_, outputs_, steps,
                                           gradient + units_ * inputs_, lanes_);
    laneKernels().accumulateBiasGradient(sums(0), units_, steps, gradient + biasOffset(), lanes_);
  }

  void forget(int step, int lane) override {
    forgotten_.push_back({step, lane});
    clearLane(lane, previousOutputs(step));
  }

  void reset() override {
    std::fill_n(previousOutputs(0), outputs_ * lanes_, 0.0f);
    forgotten_.clear();
  }

  void carryOver(int steps) override {
    std::copy_n(previousOutputs(steps), outputs_ * lanes_, previousOutputs(0));
    forgotten_.clear();
  }

 protected:
  virtual void activate(int step) = 0;
  virtual void activateBackward(int step, const float* gradient) = 0;

  void clearLane(int lane, float* rows) const {
    for (int row = 0; row < outputs_; ++row) rows[row * lanes_ + lane] = 0.0f;
  }
  struct Forgotten {
    int step;
    int lane;
  };
  const std::vector<Forgotten>& forgotten() const { return forgotten_; }

 private:
  int biasOffset() const { return units_ * (inputs_ + outputs_); }
  const float* recurrentWeights(const float* parameters) const { return parameters + units_ * inputs_; }
  float* previousOutputs(int step) { return previous_outputs_.data() + at(step, outputs_); }

  std::vector<float> previous_outputs_;  ///< before each step, and after the last
  std::vector<float> carried_gradient_;  ///< by the output of the step before
  std::vector<Forgotten> forgotten_;
};

class PlainRecurrentLanes : public RecurrentLanes {
 public:
  PlainRecurrentLanes(const RecurrentLayer& layer, int lanes, int steps)
      : RecurrentLanes(static_cast<int>(layer.input.cols()), static_cast<int>(layer.input.rows()),
                       static_cast<int>(layer.input.rows()), lanes, steps) {}

 protected:
  void activate(int step) override {
    std::copy_n(sums(step), units_ * lanes_, LaneLayer::results(step));
    laneKernels().applyTanh(LaneLayer::results(step), units_ * lanes_);
  }
  void activateBackward(int step, const float* gradient) override {
    std::copy_n(gradient, units_ * lanes_, sums(step));
    laneKernels().multiplyByTanhDerivative(results(step), sums(step), units_ * lanes_);
  }
};

class LstmLanes : public RecurrentLanes {
 public:
  LstmLanes(const LstmLayer& layer, int lanes, int steps)
      : RecurrentLanes(static_cast<int>(layer.input.cols()), static_cast<int>(layer.input.rows()),
                       static_cast<int>(layer.recurrent.cols()), lanes, steps),
        candidate_(layer.candidate),
        cells_(static_cast<std::size_t>(outputs_) * static_cast<std::size_t>(lanes * (steps + 1))),
        cell_tanhs_(cells_.size()),
        cell_gradient_(static_cast<std::size_t>(outputs_ * lanes)) {}

  void startBackward() override {
    RecurrentLanes::startBackward();
    std::fill(cell_gradient_.begin(), cell_gradient_.end(), 0.0f);
  }
  void backward(const float* parameters, int step) override {
    RecurrentLanes::backward(parameters, step);
    for (const Forgotten& lost : forgotten()) {
      if (lost.step == step) clearLane(lost.lane, cell_gradient_.data());
    }
  }
  void forget(int step, int lane) override {
    RecurrentLanes::forget(step, lane);
    clearLane(lane, cells(step));
  }
  void reset() override {
    RecurrentLanes::reset();
    std::fill_n(cells(0), outputs_ * lanes_, 0.0f);
  }
  void carryOver(int steps) override {
    RecurrentLanes::carryOver(steps);
    std::copy_n(cells(steps), outputs_ * lanes_, cells(0));
  }

 protected:
  void activate(int step) override {
    laneKernels().lstmForward(sums(step), cells(step), cells(step + 1), cell_tanhs_.data() + at(step, outputs_),
                              LaneLayer::results(step), outputs_, lanes_, candidate_);
  }
  void activateBackward(int step, const float* gradient) override {
    laneKernels().lstmBackward(sums(step), cells(step), cell_tanhs_.data() + at(step, outputs_), gradient,
                               cell_gradient_.data(), outputs_, lanes_, candidate_);
  }

 private:
  float* cells(int step) { return cells_.data() + at(step, outputs_); }

  Activation candidate_;
  std::vector<float> cells_;  ///< cell states before each step, and after the last
  std::vector<float> cell_tanhs_;
  std::vector<float> cell_gradient_;
};

}  // namespace

std::unique_ptr<LaneLayer> makeLaneLayer(const Layer& layer, int lanes, int steps) {
  if (const auto* dense = std::get_if<DenseLayer>(&layer)) return std::make_unique<DenseLanes>(*dense, lanes, steps);
  if (const auto* lstm = std::get_if<LstmLayer>(&layer)) return std::make_unique<LstmLanes>(*lstm, lanes, steps);
  if (const auto* recurrent = std::get_if<RecurrentLayer>(&layer)) {
    return std::make_unique<PlainRecurrentLanes>(*recurrent, lanes, steps);
  }
  throw std::invalid_argument("a softmax can only be trained as the last of several layers, with the cross-entropy");
}

}  // namespace lstm_planner
