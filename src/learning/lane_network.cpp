#include "lane_network.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "lane_kernels.hpp"

namespace lstm_planner {

/// A layer with what it computed in each step of the window.
class LaneNetwork::LaneLayer {
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
  virtual void beginBackward() {}
  virtual void addGradient(const float* inputs, int steps, float* gradient) const {
    accumulateWeightGradient(sums(0), inputs, units_, inputs_, steps, gradient, lanes_);
    accumulateBiasGradient(sums(0), units_, steps, gradient + units_ * inputs_, lanes_);
  }
  virtual void forget(int /*step*/, int /*lane*/) {}
  virtual void carryOver(int /*steps*/) {}
  virtual int stateRows() const { return 0; }
  virtual void readState(float* /*state*/) const {}
  virtual void writeState(const float* /*state*/) {}

  int outputs() const { return outputs_; }
  const float* results(int step) const { return results_.data() + at(step, outputs_); }
  float* resultGradient() { return result_gradients_.data(); }

  /// inputs_gradient = transposed input weights * gradient by the weighted sums.
  void inputGradient(const float* parameters, int step, float* gradient) const {
    std::fill_n(gradient, inputs_ * lanes_, 0.0f);
    accumulateProduct(parameters, units_, 1, inputs_, units_, sums(step), gradient, lanes_);
  }

 protected:
  std::size_t at(int step, int rows) const {
    return static_cast<std::size_t>(step) * static_cast<std::size_t>(rows * lanes_);
  }
  float* sums(int step) { return sums_.data() + at(step, units_); }
  const float* sums(int step) const { return sums_.data() + at(step, units_); }
  float* results(int step) { return results_.data() + at(step, outputs_); }

  void weigh(const float* weights, const float* bias, int step, const float* inputs) {
    setRows(bias, units_, sums(step), lanes_);
    accumulateProduct(weights, 1, units_, units_, inputs_, inputs, sums(step), lanes_);
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

namespace {

using LaneLayer = LaneNetwork::LaneLayer;

class DenseLanes : public LaneLayer {
 public:
  DenseLanes(const DenseLayer& layer, int lanes, int steps)
      : LaneLayer(static_cast<int>(layer.weights.cols()), static_cast<int>(layer.weights.rows()),
                  static_cast<int>(layer.weights.rows()), lanes, steps),
        activation_(layer.activation) {
    if (activation_ != Activation::kIdentity && activation_ != Activation::kTanh) {
      throw std::invalid_argument("a dense layer for reinforcement learning is neither linear nor tanh");
    }
  }

  void forward(const float* parameters, int step, const float* inputs) override {
    weigh(parameters, parameters + units_ * inputs_, step, inputs);
    std::copy_n(sums(step), units_ * lanes_, LaneLayer::results(step));
    if (activation_ == Activation::kTanh) applyTanh(LaneLayer::results(step), units_ * lanes_);
  }

  void backward(const float* /*parameters*/, int step) override {
    std::copy_n(resultGradient(), units_ * lanes_, sums(step));
    if (activation_ == Activation::kTanh) multiplyByTanhDerivative(results(step), sums(step), units_ * lanes_);
  }

 private:
  Activation activation_;
};

/// What the two recurrent kinds share: their state before each step, and the way of errors from step to step.
class RecurrentLanes : public LaneLayer {
 public:
  RecurrentLanes(int inputs, int units, int cells, int lanes, int steps)
      : LaneLayer(inputs, units, cells, lanes, steps),
        previous_outputs_(static_cast<std::size_t>(cells) * static_cast<std::size_t>(lanes * (steps + 1))),
        carried_gradient_(static_cast<std::size_t>(cells * lanes)) {}

  int parameterCount() const override { return LaneLayer::parameterCount() + units_ * outputs_; }

  void forward(const float* parameters, int step, const float* inputs) override {
    weigh(parameters, parameters + biasOffset(), step, inputs);
    accumulateProduct(recurrentWeights(parameters), 1, units_, units_, outputs_, previousOutputs(step), sums(step),
                      lanes_);
    activate(step);
    std::copy_n(results(step), outputs_ * lanes_, previousOutputs(step + 1));
  }

  void beginBackward() override { std::fill(carried_gradient_.begin(), carried_gradient_.end(), 0.0f); }

  void backward(const float* parameters, int step) override {
    float* gradient = resultGradient();
    for (int i = 0; i < outputs_ * lanes_; ++i) gradient[i] += carried_gradient_[static_cast<std::size_t>(i)];
    activateBackward(step, gradient);
    std::fill(carried_gradient_.begin(), carried_gradient_.end(), 0.0f);
    accumulateProduct(recurrentWeights(parameters), units_, 1, outputs_, units_, sums(step), carried_gradient_.data(),
                      lanes_);
    for (const Forgotten& forgotten : forgotten_) {
      if (forgotten.step == step) clearLane(forgotten.lane, carried_gradient_.data());
    }
  }

  void addGradient(const float* inputs, int steps, float* gradient) const override {
    accumulateWeightGradient(sums(0), inputs, units_, inputs_, steps, gradient, lanes_);
    accumulateWeightGradient(sums(0), previous_outputs_.data(), units_, outputs_, steps, gradient + units_ * inputs_,
                             lanes_);
    accumulateBiasGradient(sums(0), units_, steps, gradient + biasOffset(), lanes_);
  }

  void forget(int step, int lane) override {
    forgotten_.push_back({step, lane});
    clearLane(lane, previousOutputs(step));
  }

  void carryOver(int steps) override {
    std::copy_n(previousOutputs(steps), outputs_ * lanes_, previousOutputs(0));
    forgotten_.clear();
  }

  int stateRows() const override { return outputs_; }
  void readState(float* state) const override { std::copy_n(previous_outputs_.data(), outputs_ * lanes_, state); }
  void writeState(const float* state) override {
    std::copy_n(state, outputs_ * lanes_, previousOutputs(0));
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
    applyTanh(LaneLayer::results(step), units_ * lanes_);
  }
  void activateBackward(int step, const float* gradient) override {
    std::copy_n(gradient, units_ * lanes_, sums(step));
    multiplyByTanhDerivative(results(step), sums(step), units_ * lanes_);
  }
};

class LstmLanes : public RecurrentLanes {
 public:
  LstmLanes(const LstmLayer& layer, int lanes, int steps)
      : RecurrentLanes(static_cast<int>(layer.input.cols()), static_cast<int>(layer.input.rows()),
                       static_cast<int>(layer.recurrent.cols()), lanes, steps),
        cells_(static_cast<std::size_t>(outputs_) * static_cast<std::size_t>(lanes * (steps + 1))),
        cell_tanhs_(cells_.size()),
        cell_gradient_(static_cast<std::size_t>(outputs_ * lanes)) {
    if (layer.candidate != Activation::kTanh) {
      throw std::invalid_argument("an LSTM layer for reinforcement learning has a candidate that is not tanh");
    }
  }

  void beginBackward() override {
    RecurrentLanes::beginBackward();
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
  void carryOver(int steps) override {
    RecurrentLanes::carryOver(steps);
    std::copy_n(cells(steps), outputs_ * lanes_, cells(0));
  }
  int stateRows() const override { return 2 * outputs_; }
  void readState(float* state) const override {
    RecurrentLanes::readState(state);
    std::copy_n(cells_.data(), outputs_ * lanes_, state + outputs_ * lanes_);
  }
  void writeState(const float* state) override {
    RecurrentLanes::writeState(state);
    std::copy_n(state + outputs_ * lanes_, outputs_ * lanes_, cells(0));
  }

 protected:
  void activate(int step) override {
    lstmForward(sums(step), cells(step), cells(step + 1), cell_tanhs_.data() + at(step, outputs_),
                LaneLayer::results(step), outputs_, lanes_);
  }
  void activateBackward(int step, const float* gradient) override {
    lstmBackward(sums(step), cells(step), cell_tanhs_.data() + at(step, outputs_), gradient, cell_gradient_.data(),
                 outputs_, lanes_);
  }

 private:
  float* cells(int step) { return cells_.data() + at(step, outputs_); }

  std::vector<float> cells_;  ///< cell states before each step, and after the last
  std::vector<float> cell_tanhs_;
  std::vector<float> cell_gradient_;
};

std::unique_ptr<LaneLayer> makeLaneLayer(const Layer& layer, int lanes, int steps) {
  if (const auto* dense = std::get_if<DenseLayer>(&layer)) return std::make_unique<DenseLanes>(*dense, lanes, steps);
  if (const auto* lstm = std::get_if<LstmLayer>(&layer)) return std::make_unique<LstmLanes>(*lstm, lanes, steps);
  if (const auto* recurrent = std::get_if<RecurrentLayer>(&layer)) {
    return std::make_unique<PlainRecurrentLanes>(*recurrent, lanes, steps);
  }
  throw std::invalid_argument("a softmax layer cannot be part of a network for reinforcement learning");
}

}  // namespace

LaneNetwork::LaneNetwork(const LayerStack& layers, int lanes, int steps) : lanes_(lanes), steps_(steps) {
  validateLayers(layers);
  if (lanes < kLaneGroup || lanes % kLaneGroup != 0 || steps < 1) {
    throw std::invalid_argument(std::to_string(lanes) + " lanes and " + std::to_string(steps) +
                                " steps, expected a positive multiple of " + std::to_string(kLaneGroup) +
                                " and at least one");
  }
  input_size_ = lstm_planner::inputSize(layers);
  output_size_ = lstm_planner::outputSize(layers);
  for (const Layer& layer : layers) layers_.push_back(makeLaneLayer(layer, lanes, steps));
  inputs_.assign(offset(steps, input_size_), 0.0f);
  output_gradient_.assign(offset(steps, output_size_), 0.0f);
}

LaneNetwork::LaneNetwork(LaneNetwork&&) noexcept = default;
LaneNetwork& LaneNetwork::operator=(LaneNetwork&&) noexcept = default;
LaneNetwork::~LaneNetwork() = default;

const float* LaneNetwork::forward(const Eigen::VectorXf& parameters, int step) {
  const float* values = inputs(step);
  const float* own = parameters.data();
  for (const auto& layer : layers_) {
    layer->forward(own, step, values);
    values = std::as_const(*layer).results(step);
    own += layer->parameterCount();
  }
  return values;
}

const float* LaneNetwork::outputs(int step) const { return std::as_const(*layers_.back()).results(step); }

void LaneNetwork::forget(int step, int lane) {
  for (const auto& layer : layers_) layer->forget(step, lane);
}

void LaneNetwork::carryOver(int steps) {
  for (const auto& layer : layers_) layer->carryOver(steps);
}

std::vector<float> LaneNetwork::state() const {
  std::vector<float> state;
  for (const auto& layer : layers_) {
    const std::size_t first = state.size();
    state.resize(first + static_cast<std::size_t>(layer->stateRows() * lanes_));
    layer->readState(state.data() + first);
  }
  return state;
}

void LaneNetwork::setState(const std::vector<float>& state) {
  const float* own = state.data();
  for (const auto& layer : layers_) {
    layer->writeState(own);
    own += layer->stateRows() * lanes_;
  }
}

void LaneNetwork::backward(const Eigen::VectorXf& parameters, int steps, Eigen::VectorXf& gradient) {
  for (const auto& layer : layers_) layer->beginBackward();
  for (int step = steps; step-- > 0;) {
    const float* own = parameters.data() + parameters.size();
    std::copy_n(outputGradient(step), output_size_ * lanes_, layers_.back()->resultGradient());
    for (std::size_t index = layers_.size(); index-- > 0;) {
      LaneLayer& layer = *layers_[index];
      own -= layer.parameterCount();
      layer.backward(own, step);
      if (index > 0) layer.inputGradient(own, step, layers_[index - 1]->resultGradient());
    }
  }
  float* own_gradient = gradient.data();
  for (std::size_t index = 0; index < layers_.size(); ++index) {
    const float* values = index == 0 ? inputs_.data() : std::as_const(*layers_[index - 1]).results(0);
    layers_[index]->addGradient(values, steps, own_gradient);
    own_gradient += layers_[index]->parameterCount();
  }
}

}  // namespace lstm_planner
