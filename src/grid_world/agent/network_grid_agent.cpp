#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"

#include <array>
#include <cstdint>
#include <limits>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"
#include "lstm_planner/training/policy_gradient.hpp"

namespace lstm_planner {
namespace {

/// Refuses those of another model.
const LayerStack& layersOf(const Model& model) {
  checkGridMetadata(model.metadata);
  checkGridNetwork(model.layers);
  return model.layers;
}

}  // namespace

NetworkGridAgent::NetworkGridAgent(const Model& model, const Options& options)
    : shield_(options.shield),
      draw_after_(options.draw_after),
      corner_cutting_(options.corner_cutting),
      network_(layersOf(model)),
      bound_(options.detour) {
  if (options.guided) {
    GridGuideParameters guide = options.guide;
    guide.corner_cutting = options.corner_cutting;
    guide_ = std::make_unique<GridGuide>(guide);
  }
}

void NetworkGridAgent::start(CellIndex start, CellIndex goal) {
  if (guide_) guide_->start(start, goal);
  bound_.start();
  previous_direction_ = kNoPath;
  walked_ = 0.0;
  nearest_.clear();
  network_.reset();
}

void NetworkGridAgent::observe(const GridObservation& observation) {
  observation_ = observation;
  if (guide_) guide_->observe(observation);
  nearest_.note(octileDistance(observation.cell, observation.goal).length());
  Eigen::Matrix<float, kGridInputs, 1> input;
  encodeGrid(observation, previous_direction_, input.data(), 1);
  preferences_ = network_.forward(input);
  choose();
}

void NetworkGridAgent::choose() {
  leader_ = GridLeader::kNetwork;
  on_path_ = false;
  direction_ = bestMove();
  Eigen::Index preferred = 0;
  preferences_.maxCoeff(&preferred);
  overruled_ = direction_ == static_cast<int>(preferred) ? Overruled::kNo : Overruled::kByShield;
  if (guide_) {
    chooseWithinBound(direction_);
  } else if (draw_after_ > 0 && nearest_.steps() >= draw_after_) {
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
  direction_ = guide_->decide();
  leader_ = guide_->leader();
}

bool NetworkGridAgent::mayMove(int direction) const {
  return !shield_ || movePossible(observation_.ranges, direction, corner_cutting_);
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
  Random random(static_cast<std::uint64_t>(nearest_.steps()));
  std::array<float, kGridMoveCount> chances{};
  const float total = fillChances(
      kGridMoveCount, [this](int direction) { return mayMove(direction); },
      [this](int direction) { return preferences_[direction]; }, chances.data());
  return total > 0.0f ? drawByChances(kGridMoveCount, total, &random, chances.data()) : kNoPath;
}

void NetworkGridAgent::step(int direction, bool moved) {
  if (!moved) return;
  previous_direction_ = direction;
  bound_.endStep(1.0);
  walked_ += moveLength(direction);
}

std::size_t NetworkGridAgent::peakBytes() const {
  const std::size_t network = network_.weights() * sizeof(float) + network_.stateBytes();
  return sizeof(*this) + (guide_ ? guide_->peakBytes() : 0) + network;
}

}  // namespace lstm_planner
