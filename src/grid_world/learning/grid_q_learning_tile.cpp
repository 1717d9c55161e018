#include "grid_world/learning/grid_q_learning_tile.hpp"

#include <algorithm>
#include <array>

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"

namespace lstm_planner {
namespace {

/// Where a network's outputs for an agent say something of a direction.
int outputAt(int actor, int direction) { return direction * QTile::kActors + actor; }

/// One of the moves that the shield allows, each equally likely.
int randomMove(GridActor& walker) {
  std::array<int, kGridMoveCount> moves{};
  std::size_t count = 0;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (walker.possible(direction)) moves[count++] = direction;
  }
  return moves[uniformIndex(walker.random(), count)];
}

}  // namespace

void GridActor::startEpisode() {
  episode_ = course_->draw(random_);
  walk_ = GridWalk(episode_.goal->map->ranges, episode_.start, episode_.goal->goal);
  walked_ = 0.0;
  previous_direction_ = kNoPath;
}

GridActor::Outcome GridActor::step(int direction, int max_steps) {
  const float before = distance();
  walk_.move(direction);
  walked_ += moveLength(direction);
  previous_direction_ = direction;
  Outcome outcome;
  outcome.arrived = walk_.hasArrived();
  outcome.timed_out = !outcome.arrived && walk_.moves() >= max_steps;
  outcome.reward = static_cast<double>(before - distance()) - kStepCost;
  if (outcome.arrived) {
    outcome.reward += kArrivalBonus;
    outcome.ratio = walked_ / static_cast<double>(episode_.goal->distances.at(episode_.start));
  }
  if (outcome.arrived || outcome.timed_out) startEpisode();
  return outcome;
}

QSums& QSums::operator+=(const QSums& other) {
  steps += other.steps;
  squared_error += other.squared_error;
  reward += other.reward;
  ended += other.ended;
  arrived += other.arrived;
  ratio += other.ratio;
  return *this;
}

QTile::QTile(const GridQLearningParameters& parameters, const LayerStack& layers, const GridCourse& course,
             Random* seeds)
    : parameters_(parameters),
      network_(layers, kActors, parameters.window + 1),
      target_network_(layers, kActors, 1),
      windows_(kActors, std::vector<QTransition>(static_cast<std::size_t>(parameters.window + 1))) {
  for (int actor = 0; actor < kActors; ++actor) actors_.emplace_back(course, (*seeds)());
}

QSums QTile::run(const Eigen::VectorXf& weights, const Eigen::VectorXf& target_weights, double epsilon) {
  sums_ = {};
  gradient_.setZero(weights.size());
  // The state after the window is looked at too, for its value; the next window starts with it.
  for (int step = 0; step <= parameters_.window; ++step) {
    observe(step);
    network_.forward(weights, step);
    target_network_.forward(target_weights, 0);
    for (int actor = 0; actor < kActors; ++actor) {
      valueState(step, actor);
      if (step < parameters_.window) move(step, actor, epsilon);
    }
    if (step < parameters_.window) target_network_.carryOver(1);
  }
  for (int actor = 0; actor < kActors; ++actor) judge(actor);
  network_.backward(weights, parameters_.window, gradient_);
  network_.carryOver(parameters_.window);
  return sums_;
}

void QTile::observe(int step) {
  for (int actor = 0; actor < kActors; ++actor) {
    GridActor& walker = actors_[static_cast<std::size_t>(actor)];
    if (step > 0 || !observed_) walker.observe();
    if (walker.atStart()) {
      network_.forget(step, actor);
      target_network_.forget(0, actor);
    }
    encodeGrid(walker.observation(), walker.previousDirection(), network_.inputs(step) + actor, kActors);
  }
  std::copy_n(network_.inputs(step), network_.inputSize() * network_.lanes(), target_network_.inputs(0));
  observed_ = true;
}

/// Fills in the best move and the value of the state in which a step starts.
void QTile::valueState(int step, int actor) {
  const GridActor& walker = actors_[static_cast<std::size_t>(actor)];
  const auto best = [&](const float* outputs) {
    int direction = -1;
    for (int candidate = 0; candidate < kGridMoveCount; ++candidate) {
      if (!walker.possible(candidate)) continue;
      if (direction < 0 || outputs[outputAt(actor, candidate)] > outputs[outputAt(actor, direction)]) {
        direction = candidate;
      }
    }
    return direction;
  };
  const float* target_outputs = target_network_.outputs(0);
  QTransition& transition = windows_[static_cast<std::size_t>(actor)][static_cast<std::size_t>(step)];
  transition.direction = best(network_.outputs(step));
  const int chosen = parameters_.double_q ? transition.direction : best(target_outputs);
  transition.value = kValueScale * static_cast<double>(target_outputs[outputAt(actor, chosen)]);
}

void QTile::move(int step, int actor, double epsilon) {
  GridActor& walker = actors_[static_cast<std::size_t>(actor)];
  QTransition& transition = windows_[static_cast<std::size_t>(actor)][static_cast<std::size_t>(step)];
  const int best = transition.direction;
  if (uniform(walker.random()) < epsilon) transition.direction = randomMove(walker);
  transition.greedy = transition.direction == best;
  transition.estimate =
      kValueScale * static_cast<double>(network_.outputs(step)[outputAt(actor, transition.direction)]);
  const GridActor::Outcome outcome = walker.step(transition.direction, parameters_.max_steps);
  transition.reward = outcome.reward;
  transition.arrived = outcome.arrived;
  transition.timed_out = outcome.timed_out;
  if (outcome.arrived || outcome.timed_out) sums_.ended += 1.0;
  if (outcome.arrived) sums_.arrived += 1.0;
  sums_.ratio += outcome.ratio;
}

/// From the targets of one agent's steps, the derivatives by the network's outputs.
void QTile::judge(int actor) {
  const std::vector<QTransition>& window = windows_[static_cast<std::size_t>(actor)];
  const std::vector<double> targets = lambdaTargets(window, parameters_.discount, parameters_.trace_decay);
  for (int step = 0; step < parameters_.window; ++step) {
    const QTransition& transition = window[static_cast<std::size_t>(step)];
    const double error = transition.estimate - targets[static_cast<std::size_t>(step)];
    float* gradient = network_.outputGradient(step);
    for (int direction = 0; direction < kGridMoveCount; ++direction) gradient[outputAt(actor, direction)] = 0.0f;
    gradient[outputAt(actor, transition.direction)] =
        static_cast<float>(std::clamp(error, -parameters_.huber, parameters_.huber) / kValueScale);
    sums_.steps += 1.0;
    sums_.squared_error += error * error;
    sums_.reward += transition.reward;
  }
}

}  // namespace lstm_planner
