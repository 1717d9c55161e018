#include "lstm_planner/training/lane_network.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "training/lane_layer.hpp"

namespace lstm_planner {

LaneNetwork::LaneNetwork(const LayerStack& layers, int lanes, int steps) : lanes_(lanes) {
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

void LaneNetwork::reset() {
  for (const auto& layer : layers_) layer->reset();
}

void LaneNetwork::carryOver(int steps) {
  for (const auto& layer : layers_) layer->carryOver(steps);
}

void LaneNetwork::backward(const Eigen::VectorXf& parameters, int steps, Eigen::VectorXf& gradient) {
  for (const auto& layer : layers_) layer->startBackward();
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
