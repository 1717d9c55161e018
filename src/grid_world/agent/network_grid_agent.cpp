#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/base/learning/policy_gradient.hpp"

namespace lstm_planner {

NetworkGridAgent::NetworkGridAgent(const Model& model, const Options& options)
    : shield_(options.shield),
      draw_after_(options.draw_after),
      corner_cutting_(options.corner_cutting),
      encoder_(readGridEncoderParameters(model.metadata)),
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
    GridRescueParameters rescue = options.rescue;
    rescue.corner_cutting = options.corner_cutting;
    rescue_.emplace(rescue);
  }
}

void NetworkGridAgent::start(CellIndex start, CellIndex /*goal*/) {
  if (!memory_) memory_.emplace(makeGridMemory(encoder_.parameters(), corner_cutting_));
  memory_->start();
  peak_bytes_ = memory_->bytes();
  if (rescue_) rescue_->start(start);
  watch_.start();
  if (network_) network_->reset();
  if (views_) views_->reset();
}

void NetworkGridAgent::observe(const GridObservation& observation) {
  if (memory_) {
    memory_->observe(observation);
    if (!rescue_) watch_.observe(observation, memory_->inNewPlace());
    const double detour = memory_->planner() != nullptr ? memory_->planner()->detour(observation) : 0.0;
    if (rescue_ && rescue_->isNeeded(observation, memory_->inNewPlace(), detour)) takeOver(observation);
  }
  if (memory_) {
    judgeMoves();
    return;
  }
  rescue_->observe(observation);
  peak_bytes_ = std::max(peak_bytes_, rescue_->bytes());
}

void NetworkGridAgent::takeOver(const GridObservation& observation) {
  std::optional<RollingGrid> walls;
  if (memory_->planner() != nullptr) walls = memory_->planner()->walls();
  memory_.reset();
  rescue_->takeOver(observation, walls ? &*walls : nullptr);
}

void NetworkGridAgent::judgeMoves() {
  encoder_.prepare(*memory_);
  encoder_.encodeViews(inputs_.data(), encoder_.parameters().views);
  if (network_) preferences_ = network_->forward(Eigen::Map<const Eigen::VectorXf>(inputs_.data(), inputs_.rows()));
  if (views_) preferences_ = views_->forward(inputs_).row(0);
}

int NetworkGridAgent::decide() {
  if (isRescued()) return rescue_->decide();
  constexpr int kAnyDetour = std::numeric_limits<int>::max();
  const bool draws = draw_after_ > 0 && !rescue_ && watch_.isExhausted(draw_after_, kAnyDetour);
  return draws ? drawnMove() : preferredMove();
}

bool NetworkGridAgent::mayMove(int direction) const {
  return !shield_ || movePossible(memory_->observation().ranges, direction, corner_cutting_);
}

int NetworkGridAgent::preferredMove() const {
  int best = kNoPath;
  float largest = -std::numeric_limits<float>::infinity();
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (mayMove(direction) && preferences_[direction] > largest) {
      largest = preferences_[direction];
      best = direction;
    }
  }
  return best;
}

int NetworkGridAgent::drawnMove() const {
  // By the number of steps alone: the same walk every time, and the same move when asked twice.
  Random random(static_cast<std::uint64_t>(memory_->stepsSinceBest()));
  std::array<float, kGridMoveCount> chances{};
  const float total = fillChances(
      kGridMoveCount, [this](int direction) { return mayMove(direction); },
      [this](int direction) { return preferences_[direction]; }, chances.data());
  return total > 0.0f ? drawByChances(kGridMoveCount, total, &random, chances.data()) : kNoPath;
}

int NetworkGridAgent::searchedDirection() const {
  return memory_ && memory_->planner() != nullptr ? memory_->planner()->direction() : kNoPath;
}

void NetworkGridAgent::step(int direction, bool moved) {
  if (moved && memory_) memory_->step(direction);
}

std::size_t NetworkGridAgent::peakBytes() const {
  std::size_t network = 0;
  if (views_) network = views_->bytes();
  if (network_) {
    const auto state = 3 * static_cast<std::size_t>(network_->hiddenState().size());
    network = (network_->weights() + state) * sizeof(float);
  }
  return sizeof(*this) + peak_bytes_ + network;
}

}  // namespace lstm_planner
