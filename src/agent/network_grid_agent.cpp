#include "lstm_planner/agent/network_grid_agent.hpp"

#include <limits>
#include <stdexcept>

namespace lstm_planner {

NetworkGridAgent::NetworkGridAgent(const Model& model, const Options& options)
    : options_(options),
      encoder_(readGridEncoderParameters(model.metadata)),
      network_(model.layers),
      memory_(makeGridMemory(encoder_.parameters(), options.corner_cutting)),
      hidden_states_(static_cast<std::size_t>(encoder_.parameters().views), network_.hiddenState()),
      input_(encoder_.size()),
      preferences_(kGridMoveCount) {
  if (network_.inputSize() != encoder_.size() || network_.outputSize() != encoder_.outputs()) {
    throw std::invalid_argument("the network has " + std::to_string(network_.inputSize()) + " inputs and " +
                                std::to_string(network_.outputSize()) + " outputs, its description expects " +
                                std::to_string(encoder_.size()) + " and " + std::to_string(encoder_.outputs()));
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
  for (Network::HiddenState& state : hidden_states_) state.setZero();
}

void NetworkGridAgent::observe(const GridObservation& observation) {
  memory_.observe(observation);
  if (escape_) escape_->observe(observation, memory_.inNewPlace());
  // The hidden state waits while the escape leads: what it was made of is where the network was going.
  if (!isEscaping()) judgeMoves();
}

void NetworkGridAgent::judgeMoves() {
  encoder_.look(memory_);
  for (std::size_t view = 0; view < hidden_states_.size(); ++view) {
    encoder_.encode(static_cast<int>(view), input_.data(), 1);
    network_.setHiddenState(hidden_states_[view]);
    const Eigen::VectorXf& output = network_.forward(input_);
    hidden_states_[view] = network_.hiddenState();
    if (hidden_states_.size() == 1) {
      preferences_ = output;
    } else {
      preferences_[static_cast<Eigen::Index>(view)] = output[0];
    }
  }
}

int NetworkGridAgent::decide() {
  if (isEscaping()) return escape_->decide();
  int best = kNoWay;
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

void NetworkGridAgent::step(int direction, bool moved) {
  if (moved) memory_.step(direction);
}

std::size_t NetworkGridAgent::peakBytes() const {
  const std::size_t state = static_cast<std::size_t>(network_.hiddenState().size()) * (hidden_states_.size() + 2);
  const std::size_t escape = escape_ ? escape_->peakBytes() : 0;
  return sizeof(*this) + memory_.bytes() + escape + (countWeights(network_.layers()) + state) * sizeof(float);
}

}  // namespace lstm_planner
