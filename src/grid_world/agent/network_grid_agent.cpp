#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"

#include <limits>
#include <stdexcept>

namespace lstm_planner {

NetworkGridAgent::NetworkGridAgent(const Model& model, const Options& options)
    : options_(options),
      encoder_(readGridEncoderParameters(model.metadata)),
      memory_(makeGridMemory(encoder_.parameters(), options.corner_cutting)),
      inputs_(encoder_.size(), encoder_.parameters().views),
      preferences_(kGridMoveCount) {
  const int inputs = inputSize(model.layers);
  const int outputs = outputSize(model.layers);
  if (inputs != encoder_.size() || outputs != encoder_.outputs()) {
    throw std::invalid_argument("the network has " + std::to_string(inputs) + " inputs and " + std::to_string(outputs) +
                                " outputs, its description expects " + std::to_string(encoder_.size()) + " and " +
                                std::to_string(encoder_.outputs()));
  }
  if (inputs_.cols() == 1) {
    network_.emplace(model.layers);
  } else {
    views_.emplace(model.layers, encoder_.parameters().views);
  }
  if (options.escape) {
    GridEscapeParameters escape = options.escape_parameters;
    escape.boundary.corner_cutting = options.corner_cutting;
    escape_.emplace(escape);
  }
}

void NetworkGridAgent::start(CellIndex /*start*/, CellIndex /*goal*/) {
  memory_.start();
  if (escape_) escape_->start();
  if (network_) network_->reset();
  if (views_) views_->reset();
}

void NetworkGridAgent::observe(const GridObservation& observation) {
  memory_.observe(observation);
  if (escape_) escape_->observe(observation, memory_.inNewPlace());
  // The hidden state waits while the escape leads: what it was made of is where the network was going.
  if (!isEscaping()) judgeMoves();
}

void NetworkGridAgent::judgeMoves() {
  encoder_.look(memory_);
  const int views = encoder_.parameters().views;
  for (int view = 0; view < views; ++view) encoder_.encode(view, inputs_.data() + view, views);
  if (network_) preferences_ = network_->forward(Eigen::Map<const Eigen::VectorXf>(inputs_.data(), inputs_.rows()));
  if (views_) preferences_ = views_->forward(inputs_).row(0);
}

int NetworkGridAgent::decide() {
  if (isEscaping()) return escape_->decide();
  int best = kNoPath;
  float largest = -std::numeric_limits<float>::infinity();
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (options_.shield && !movePossible(memory_.observation().ranges, direction, options_.corner_cutting)) continue;
    if (preferences_[direction] > largest) {
      largest = preferences_[direction];
      best = direction;
    }
  }
  return best;
}

int NetworkGridAgent::searchedDirection() const {
  return memory_.planner() == nullptr ? kNoPath : memory_.planner()->direction();
}

void NetworkGridAgent::step(int direction, bool moved) {
  if (moved) memory_.step(direction);
}

std::size_t NetworkGridAgent::peakBytes() const {
  const std::size_t escape = escape_ ? escape_->peakBytes() - sizeof(*escape_) : 0;
  std::size_t network = 0;
  if (views_) network = views_->bytes();
  if (network_) {
    const auto state = 3 * static_cast<std::size_t>(network_->hiddenState().size());
    network = (network_->weights() + state) * sizeof(float);
  }
  return sizeof(*this) + memory_.bytes() + escape + network;
}

}  // namespace lstm_planner
