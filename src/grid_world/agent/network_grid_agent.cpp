#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/training/policy_gradient.hpp"

namespace lstm_planner {

NetworkGridAgent::NetworkGridAgent(const Model& model, const Options& options)
    : shield_(options.shield),
      draw_after_(options.draw_after),
      corner_cutting_(options.corner_cutting),
      encoder_(readGridEncoderParameters(model.metadata)),
      network_(model.layers, fastestInstructionSet(), encoder_.parameters().views),
      memory_(makeGridMemory(encoder_.parameters(), options.corner_cutting, !options.guided)),
      bound_(options.detour),
      input_(encoder_.size()),
      preferences_(kGridMoveCount) {
  const int inputs = network_.inputSize();
  const int outputs = network_.outputSize();
  if (inputs != encoder_.size() || outputs != encoder_.outputs()) {
    throw std::invalid_argument("the network has " + std::to_string(inputs) + " inputs and " + std::to_string(outputs) +
                                " outputs, its description expects " + std::to_string(encoder_.size()) + " and " +
                                std::to_string(encoder_.outputs()));
  }
  if (options.guided) {
    GridGuideParameters guide = options.guide;
    guide.corner_cutting = options.corner_cutting;
    guide_ = std::make_unique<GridGuide>(guide);
  }
}

void NetworkGridAgent::start(CellIndex start, CellIndex /*goal*/) {
  memory_.start();
  if (guide_) guide_->start(start);
  bound_.start();
  walked_ = 0.0;
  watch_.start();
  network_.reset();
}

void NetworkGridAgent::observe(const GridObservation& observation) {
  memory_.observe(observation);
  if (guide_) guide_->observe(observation);
  if (!guide_) watch_.observe(observation, memory_.inNewPlace());
  judgeMoves();
  choose();
}

void NetworkGridAgent::judgeMoves() {
  encoder_.prepare(memory_);
  const int outputs = encoder_.outputs();
  for (int view = 0; view < network_.sequences(); ++view) {
    encoder_.encode(view, input_.data(), 1);
    preferences_.segment(view * outputs, outputs) = network_.forward(input_, view);
  }
}

void NetworkGridAgent::choose() {
  constexpr int kAnyDetour = std::numeric_limits<int>::max();
  leader_ = GridLeader::kNetwork;
  on_path_ = false;
  direction_ = bestMove();
  Eigen::Index preferred = 0;
  preferences_.maxCoeff(&preferred);
  overruled_ = direction_ == static_cast<int>(preferred) ? Overruled::kNo : Overruled::kByShield;
  if (guide_) {
    chooseWithinBound(direction_);
  } else if (draw_after_ > 0 && watch_.isExhausted(draw_after_, kAnyDetour)) {
    direction_ = drawnMove();
  }
}

void NetworkGridAgent::chooseWithinBound(int preferred) {
  const bool has_path = guide_->leader() == GridLeader::kSearch;
  const double regret =
      has_path && preferred != kNoPath ? guide_->regretOf(preferred) : std::numeric_limits<double>::infinity();
  if (bound_.allows(regret, walked_)) {
    bound_.choose(regret);
    on_path_ = regret == 0.0;
    return;
  }
  if (has_path) overruled_ = Overruled::kByBound;
  direction_ = guide_->direction();
  leader_ = guide_->leader();
}

bool NetworkGridAgent::mayMove(int direction) const {
  return !shield_ || movePossible(memory_.observation().ranges, direction, corner_cutting_);
}

int NetworkGridAgent::bestMove() const {
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
  Random random(static_cast<std::uint64_t>(memory_.stepsSinceBest()));
  std::array<float, kGridMoveCount> chances{};
  const float total = fillChances(
      kGridMoveCount, [this](int direction) { return mayMove(direction); },
      [this](int direction) { return preferences_[direction]; }, chances.data());
  return total > 0.0f ? drawByChances(kGridMoveCount, total, &random, chances.data()) : kNoPath;
}

void NetworkGridAgent::step(int direction, bool moved) {
  if (!moved) return;
  memory_.step(direction);
  bound_.endStep(1.0);
  walked_ += moveLength(direction);
}

std::size_t NetworkGridAgent::peakBytes() const {
  const std::size_t network = network_.weights() * sizeof(float) + network_.stateBytes();
  return sizeof(*this) + memory_.bytes() + (guide_ ? sizeof(*guide_) + guide_->bytes() : 0) + network;
}

}  // namespace lstm_planner
