#include "practice/drive_tile.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/training/actor_critic.hpp"
#include "lstm_planner/training/policy_gradient.hpp"

namespace lstm_planner {
namespace {

/// The critic's output times this is a return, m.
constexpr double kValueScale = 5.0;

constexpr double kAdvantageDecay = 0.95;  ///< lambda
constexpr double kClip = 0.2;             ///< how far from 1 a probability's change still counts

/// The critic judges all steps of a window at once, each in a lane. Lanes of a network come in multiples of 16, which
/// eight queues times any window are not: those without a step have inputs and gradients of zero.
int criticLanes(int steps) { return (steps + 15) / 16 * 16; }

}  // namespace

DriveTile::DriveTile(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic)
    : parameters_(parameters),
      actions_(parameters.policy.actions.size()),
      policy_inputs_(inputSize(policy)),
      views_(parameters.policy),
      queues_(views_.queues(), parameters.window, policy_inputs_),
      policy_(policy, views_.networkLanes(), parameters.window),
      critic_(critic, criticLanes(views_.queues() * parameters.window), 1) {}

void DriveTile::rewind() { policy_.reset(); }

const float* DriveTile::criticValues(int window, const Eigen::VectorXf& parameters) {
  for (int time = 0; time < parameters_.window; ++time) {
    for (int queue = 0; queue < queues_.count(); ++queue) {
      queues_.fillInputs(queues_.at(window * parameters_.window + time, queue), policy_inputs_ + kDrivePrivilegedInputs,
                         critic_.inputs(0) + time * queues_.count() + queue, critic_.lanes());
    }
  }
  return critic_.forward(parameters, 0);
}

CriticSums DriveTile::judge(const Eigen::VectorXf& critic_parameters) {
  for (int window = 0; window < queues_.windows(); ++window) {
    const float* values = criticValues(window, critic_parameters);
    for (int time = 0; time < parameters_.window; ++time) {
      for (int queue = 0; queue < queues_.count(); ++queue) {
        queues_.at(window * parameters_.window + time, queue).value =
            static_cast<float>(kValueScale) * values[time * queues_.count() + queue];
      }
    }
  }
  CriticSums sums(parameters_.course.worlds.size());
  for (int queue = 0; queue < queues_.count(); ++queue) judgeQueue(queue, &sums);
  return sums;
}

/// Advantages from the last step back.
void DriveTile::judgeQueue(int queue, CriticSums* sums) {
  Advantages advantages(parameters_.discount, kAdvantageDecay);
  for (int time = queues_.steps(); time-- > 0;) {
    DriveSlot& slot = queues_.at(time, queue);
    if (!slot.episode || slot.episode->is_example) continue;
    const PracticeEpisode& episode = *slot.episode;
    const double value = static_cast<double>(slot.value);
    const bool last = slot.step + 1 == episode.steps.size();
    const Advantages::End end =
        !last ? Advantages::End::kNone : (episode.arrived ? Advantages::End::kArrived : Advantages::End::kCutOff);
    const double advantage = advantages.before(static_cast<double>(episode.steps[slot.step].reward), value, end);
    slot.advantage = static_cast<float>(advantage);
    sums->count(episode.kind, value, advantage);
  }
}

double DriveTile::policyGradient(int window, const Eigen::VectorXf& parameters, const DriveBatchWeights& weights) {
  gradient_.setZero(parameters.size());
  double chosen = 0.0;
  for (int time = 0; time < parameters_.window; ++time) {
    for (int queue = 0; queue < queues_.count(); ++queue) {
      const DriveSlot& slot = queues_.at(window * parameters_.window + time, queue);
      if (slot.step == 0) views_.forget(time, queue, &policy_);
      views_.fillInputs(slot, queue, policy_.inputs(time));
    }
    policy_.forward(parameters, time);
    std::fill_n(policy_.outputGradient(time), policy_.outputSize() * policy_.lanes(), 0.0f);
    for (int queue = 0; queue < queues_.count(); ++queue) {
      const DriveSlot& slot = queues_.at(window * parameters_.window + time, queue);
      if (!slot.episode || !slot.episode->steps[slot.step].chosen) continue;
      if (slot.episode->is_example) {
        fillImitationGradient(slot, time, queue);
      } else {
        fillPolicyGradient(slot, time, queue, weights);
      }
      chosen += 1.0;
    }
  }
  policy_.backward(parameters, parameters_.window, gradient_);
  policy_.carryOver(parameters_.window);
  return chosen;
}

std::vector<double> DriveTile::probabilitiesOf(const DriveSlot& slot, int time, int queue) const {
  const float* before = slot.episode->probabilities.data() + slot.step * static_cast<std::size_t>(actions_);
  const float* preferences = policy_.outputs(time);
  std::vector<double> now(static_cast<std::size_t>(actions_));
  const double total = fillChances(
      actions_, [&](int k) { return before[k] > 0.0f; },
      [&](int k) { return preferences[views_.outputAt(slot, queue, k)]; }, now.data());
  for (double& probability : now) probability /= total;
  return now;
}

/// Of -weight * log(probability of the right action) by the preferences.
void DriveTile::fillImitationGradient(const DriveSlot& slot, int time, int queue) {
  const PracticeEpisode::Step& step = slot.episode->steps[slot.step];
  const std::vector<double> now = probabilitiesOf(slot, time, queue);
  for (int k = 0; k < actions_; ++k) {
    const double slope = imitationSlope(now[static_cast<std::size_t>(k)], k == step.action);
    policy_.outputGradient(time)[views_.outputAt(slot, queue, k)] =
        static_cast<float>(static_cast<double>(step.weight) * slope);
  }
}

/// Of -min(ratio * advantage, clipped ratio * advantage) - weight * entropy by the preferences.
void DriveTile::fillPolicyGradient(const DriveSlot& slot, int time, int queue, const DriveBatchWeights& weights) {
  const PracticeEpisode& episode = *slot.episode;
  const float* before = episode.probabilities.data() + slot.step * static_cast<std::size_t>(actions_);
  const std::vector<double> now = probabilitiesOf(slot, time, queue);
  const double entropy = entropyOf(actions_, now.data());
  entropy_.sum += entropy;
  entropy_.steps += 1.0;
  const int action = episode.steps[slot.step].action;
  const double ratio = now[static_cast<std::size_t>(action)] / static_cast<double>(before[action]);
  const double advantage =
      static_cast<double>(slot.advantage) / std::sqrt(weights.advantage_variances[episode.kind] + 1e-6);
  const bool clipped = advantage > 0.0 ? ratio > 1.0 + kClip : ratio < 1.0 - kClip;
  const double gain = clipped ? 0.0 : advantage * ratio;
  for (int k = 0; k < actions_; ++k) {
    const double probability = now[static_cast<std::size_t>(k)];
    if (probability <= 0.0) continue;
    const double slope = policySlope(probability, k == action, gain, weights.entropy, entropy);
    policy_.outputGradient(time)[views_.outputAt(slot, queue, k)] = static_cast<float>(slope);
  }
}

double DriveTile::criticGradient(int window, const Eigen::VectorXf& parameters) {
  gradient_.setZero(parameters.size());
  const float* values = criticValues(window, parameters);
  double steps = 0.0;
  for (int time = 0; time < parameters_.window; ++time) {
    for (int queue = 0; queue < queues_.count(); ++queue) {
      const int place = time * queues_.count() + queue;
      const DriveSlot& slot = queues_.at(window * parameters_.window + time, queue);
      const float wanted = (slot.value + slot.advantage) / static_cast<float>(kValueScale);
      const bool practised = slot.episode && !slot.episode->is_example;
      critic_.outputGradient(0)[place] = practised ? values[place] - wanted : 0.0f;
      steps += practised ? 1.0 : 0.0;
    }
  }
  critic_.backward(parameters, 1, gradient_);
  return steps;
}

}  // namespace lstm_planner
