#include "robot/learning/drive_q_tile.hpp"

#include <algorithm>

namespace lstm_planner {

DriveQTile::DriveQTile(const DriveQLearningParameters& parameters, const LayerStack& layers)
    : parameters_(parameters),
      actions_(parameters.policy.actions.size()),
      views_(parameters.policy),
      queues_(views_.queues(), parameters.window, inputSize(layers)),
      network_(layers, views_.networkLanes(), parameters.window),
      target_network_(layers, views_.networkLanes(), 1),
      steps_(static_cast<std::size_t>(views_.queues())) {}

void DriveQTile::rewind() {
  for (LaneNetwork* network : {&network_, &target_network_}) {
    network->setState(std::vector<float>(network->state().size(), 0.0f));
  }
}

/// Shows the network step `step` of a window, which is that at `time` of the queues.
void DriveQTile::fillInputs(int time, int step) {
  for (int queue = 0; queue < queues_.count(); ++queue) {
    const DriveQSlot& slot = queues_.at(time, queue);
    if (slot.step == 0) views_.forget(step, queue, &network_);
    views_.fillInputs(slot, queue, network_.inputs(step));
  }
}

ValueSums DriveQTile::judge(const Eigen::VectorXf& weights, const Eigen::VectorXf& target_weights) {
  rewind();
  for (auto& queue : steps_) queue.assign(static_cast<std::size_t>(queues_.steps() + 1), {});
  for (int time = 0; time < queues_.steps(); ++time) {
    const int step = time % parameters_.window;
    fillInputs(time, step);
    for (int queue = 0; queue < queues_.count(); ++queue) {
      if (queues_.at(time, queue).step == 0) views_.forget(0, queue, &target_network_);
    }
    std::copy_n(network_.inputs(step), network_.inputSize() * network_.lanes(), target_network_.inputs(0));
    const float* outputs = network_.forward(weights, step);
    const float* target_outputs = target_network_.forward(target_weights, 0);
    for (int queue = 0; queue < queues_.count(); ++queue) valueStep(time, queue, outputs, target_outputs);
    target_network_.carryOver(1);
    if (step + 1 == parameters_.window) network_.carryOver(parameters_.window);
  }
  rewind();
  ValueSums sums;
  for (int queue = 0; queue < queues_.count(); ++queue) judgeQueue(queue, &sums);
  return sums;
}

/// Of those that the shield allowed, or of all where it allowed none.
int DriveQTile::bestAction(const DriveQSlot& slot, int queue, const float* outputs) const {
  const char* allowed = slot.episode->allowed.data() + slot.step * static_cast<std::size_t>(actions_);
  int best = 0;
  for (int action = 1; action < actions_; ++action) {
    const bool better = outputs[views_.outputAt(slot, queue, action)] > outputs[views_.outputAt(slot, queue, best)];
    if (allowed[action] == allowed[best] ? better : allowed[action] > allowed[best]) best = action;
  }
  return best;
}

void DriveQTile::valueStep(int time, int queue, const float* outputs, const float* target_outputs) {
  const DriveQSlot& slot = queues_.at(time, queue);
  if (!slot.episode) return;
  const PracticeEpisode::Step& done = slot.episode->steps[slot.step];
  const bool last = slot.step + 1 == slot.episode->steps.size();
  QTransition& transition = steps_[static_cast<std::size_t>(queue)][static_cast<std::size_t>(time)];
  const int best = bestAction(slot, queue, outputs);
  const int valued = parameters_.double_q ? best : bestAction(slot, queue, target_outputs);
  const auto valueOf = [&](const float* values, int action) {
    return parameters_.value_scale * static_cast<double>(values[views_.outputAt(slot, queue, action)]);
  };
  transition.value = valueOf(target_outputs, valued);
  transition.estimate = valueOf(outputs, done.action);
  transition.reward = static_cast<double>(done.reward);
  transition.greedy = done.action == best;
  transition.forced = !done.chosen;
  transition.arrived = last && slot.episode->arrived;
  transition.timed_out = last && !slot.episode->arrived;
}

void DriveQTile::judgeQueue(int queue, ValueSums* sums) {
  const std::vector<QTransition>& steps = steps_[static_cast<std::size_t>(queue)];
  const std::vector<double> targets = lambdaTargets(steps, parameters_.discount, parameters_.trace_decay);
  for (int time = 0; time < queues_.steps(); ++time) {
    const auto i = static_cast<std::size_t>(time);
    DriveQSlot& slot = queues_.at(time, queue);
    slot.target = targets[i];
    slot.learns = slot.episode && !steps[i].forced && !steps[i].timed_out;
    if (!slot.learns) continue;
    sums->count(steps[i].estimate, steps[i].estimate - slot.target);
  }
}

double DriveQTile::valueGradient(int window, const Eigen::VectorXf& weights) {
  gradient_.setZero(weights.size());
  double learned = 0.0;
  for (int step = 0; step < parameters_.window; ++step) {
    const int time = window * parameters_.window + step;
    fillInputs(time, step);
    const float* outputs = network_.forward(weights, step);
    float* slopes = network_.outputGradient(step);
    std::fill_n(slopes, network_.outputSize() * network_.lanes(), 0.0f);
    for (int queue = 0; queue < queues_.count(); ++queue) {
      const DriveQSlot& slot = queues_.at(time, queue);
      if (!slot.learns) continue;
      const int place = views_.outputAt(slot, queue, slot.episode->steps[slot.step].action);
      const double error = parameters_.value_scale * static_cast<double>(outputs[place]) - slot.target;
      slopes[place] = static_cast<float>(huberDerivative(error, parameters_.huber) / parameters_.value_scale);
      learned += 1.0;
    }
  }
  network_.backward(weights, parameters_.window, gradient_);
  network_.carryOver(parameters_.window);
  return learned;
}

}  // namespace lstm_planner
