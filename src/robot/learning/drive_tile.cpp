#include "robot/learning/drive_tile.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/base/learning/actor_critic.hpp"

namespace lstm_planner {
namespace {

/// The critic's output times this is a return, m.
constexpr double kValueScale = 5.0;

}  // namespace

DriveTile::DriveTile(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic)
    : parameters_(parameters),
      actions_(parameters.policy.actions.size()),
      policy_inputs_(inputSize(policy)),
      views_(parameters.policy),
      lanes_(views_.driveLanes(), parameters.window, policy_inputs_),
      policy_(policy, views_.networkLanes(), parameters.window),
      critic_(critic, views_.driveLanes() * parameters.window, 1) {}

void DriveTile::rewind() { policy_.setState(std::vector<float>(policy_.state().size(), 0.0f)); }

const float* DriveTile::criticValues(int window, const Eigen::VectorXf& parameters) {
  for (int time = 0; time < parameters_.window; ++time) {
    for (int lane = 0; lane < lanes_.count(); ++lane) {
      lanes_.fillInputs(lanes_.at(window * parameters_.window + time, lane), policy_inputs_ + kDrivePrivilegedInputs,
                        critic_.inputs(0) + time * lanes_.count() + lane, critic_.lanes());
    }
  }
  return critic_.forward(parameters, 0);
}

std::vector<double*> numbersOf(DriveTileSums* sums) {
  std::vector<double*> numbers = {&sums->steps, &sums->returns, &sums->squared_returns, &sums->squared_errors};
  for (std::vector<double>* by_kind : {&sums->squares, &sums->counts}) {
    for (double& number : *by_kind) numbers.push_back(&number);
  }
  return numbers;
}

DriveTileSums DriveTile::judge(const Eigen::VectorXf& critic_parameters) {
  for (int window = 0; window < lanes_.windows(); ++window) {
    const float* values = criticValues(window, critic_parameters);
    for (int time = 0; time < parameters_.window; ++time) {
      for (int lane = 0; lane < lanes_.count(); ++lane) {
        lanes_.at(window * parameters_.window + time, lane).value =
            static_cast<float>(kValueScale) * values[time * lanes_.count() + lane];
      }
    }
  }
  DriveTileSums sums(parameters_.course.worlds.size());
  for (int lane = 0; lane < lanes_.count(); ++lane) judgeLane(lane, &sums);
  return sums;
}

/// Advantages from the last step back.
void DriveTile::judgeLane(int lane, DriveTileSums* sums) {
  Advantages advantages(parameters_.discount, parameters_.advantage_decay, 0.0);
  for (int time = lanes_.steps(); time-- > 0;) {
    DriveSlot& slot = lanes_.at(time, lane);
    if (!slot.episode || slot.episode->recorded) continue;
    const PracticeEpisode& episode = *slot.episode;
    const double value = static_cast<double>(slot.value);
    const bool last = slot.step + 1 == episode.steps.size();
    const Advantages::End end =
        !last ? Advantages::End::kNone : (episode.arrived ? Advantages::End::kArrived : Advantages::End::kCutOff);
    const double advantage = advantages.before(static_cast<double>(episode.steps[slot.step].reward), value, end);
    slot.advantage = static_cast<float>(advantage);
    sums->squares[episode.kind] += advantage * advantage;
    sums->counts[episode.kind] += 1.0;
    const double result = value + advantage;
    sums->steps += 1.0;
    sums->returns += result;
    sums->squared_returns += result * result;
    sums->squared_errors += advantage * advantage;
  }
}

double DriveTile::policyGradient(int window, const Eigen::VectorXf& parameters, const DriveBatchWeights& weights) {
  gradient_.setZero(parameters.size());
  double chosen = 0.0;
  for (int time = 0; time < parameters_.window; ++time) {
    for (int lane = 0; lane < lanes_.count(); ++lane) {
      const DriveSlot& slot = lanes_.at(window * parameters_.window + time, lane);
      if (slot.step == 0) views_.forget(time, lane, &policy_);
      views_.fillInputs(slot, lane, policy_.inputs(time));
    }
    policy_.forward(parameters, time);
    std::fill_n(policy_.outputGradient(time), policy_.outputSize() * policy_.lanes(), 0.0f);
    for (int lane = 0; lane < lanes_.count(); ++lane) {
      const DriveSlot& slot = lanes_.at(window * parameters_.window + time, lane);
      if (!slot.episode || !slot.episode->steps[slot.step].chosen) continue;
      if (slot.episode->recorded) {
        fillImitationGradient(slot, time, lane, weights.imitation);
      } else {
        fillPolicyGradient(slot, time, lane, weights);
      }
      chosen += 1.0;
    }
  }
  policy_.backward(parameters, parameters_.window, gradient_);
  policy_.carryOver(parameters_.window);
  return chosen;
}

/// How likely the actions are now, of those that could be chosen.
std::vector<double> DriveTile::probabilitiesOf(const DriveSlot& slot, int time, int lane) const {
  const float* before = slot.episode->probabilities.data() + slot.step * static_cast<std::size_t>(actions_);
  const float* preferences = policy_.outputs(time);
  float largest = -1e30f;
  for (int k = 0; k < actions_; ++k) {
    if (before[k] > 0.0f) largest = std::max(largest, preferences[views_.outputAt(slot, lane, k)]);
  }
  double total = 0.0;
  std::vector<double> now(static_cast<std::size_t>(actions_));
  for (int k = 0; k < actions_; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const float preference = preferences[views_.outputAt(slot, lane, k)];
    now[i] = before[k] > 0.0f ? std::exp(static_cast<double>(preference - largest)) : 0.0;
    total += now[i];
  }
  for (double& probability : now) probability /= total;
  return now;
}

/// Of -weight * log(probability of what the driver did) by the preferences.
void DriveTile::fillImitationGradient(const DriveSlot& slot, int time, int lane, double weight) {
  const PracticeEpisode::Step& step = slot.episode->steps[slot.step];
  const std::vector<double> now = probabilitiesOf(slot, time, lane);
  for (int k = 0; k < actions_; ++k) {
    const double slope = now[static_cast<std::size_t>(k)] - (k == step.action ? 1.0 : 0.0);
    policy_.outputGradient(time)[views_.outputAt(slot, lane, k)] =
        static_cast<float>(weight * static_cast<double>(step.weight) * slope);
  }
}

/// Of -min(ratio * advantage, clipped ratio * advantage) - weight * entropy by the preferences.
void DriveTile::fillPolicyGradient(const DriveSlot& slot, int time, int lane, const DriveBatchWeights& weights) {
  const PracticeEpisode& episode = *slot.episode;
  const float* before = episode.probabilities.data() + slot.step * static_cast<std::size_t>(actions_);
  const std::vector<double> now = probabilitiesOf(slot, time, lane);
  double entropy = 0.0;
  for (const double probability : now) {
    if (probability > 0.0) entropy -= probability * std::log(probability);
  }
  entropy_.sum += entropy;
  entropy_.steps += 1.0;
  const int action = episode.steps[slot.step].action;
  const double ratio = now[static_cast<std::size_t>(action)] / static_cast<double>(before[action]);
  const double advantage =
      static_cast<double>(slot.advantage) / std::sqrt(weights.advantage_variances[episode.kind] + 1e-6);
  const bool clipped = advantage > 0.0 ? ratio > 1.0 + parameters_.clip : ratio < 1.0 - parameters_.clip;
  for (int k = 0; k < actions_; ++k) {
    const double probability = now[static_cast<std::size_t>(k)];
    if (probability <= 0.0) continue;
    double slope = weights.entropy * probability * (std::log(probability) + entropy);
    if (!clipped) slope += advantage * ratio * (probability - (k == action ? 1.0 : 0.0));
    policy_.outputGradient(time)[views_.outputAt(slot, lane, k)] = static_cast<float>(slope);
  }
}

double DriveTile::criticGradient(int window, const Eigen::VectorXf& parameters) {
  gradient_.setZero(parameters.size());
  const float* values = criticValues(window, parameters);
  double steps = 0.0;
  for (int time = 0; time < parameters_.window; ++time) {
    for (int lane = 0; lane < lanes_.count(); ++lane) {
      const int place = time * lanes_.count() + lane;
      const DriveSlot& slot = lanes_.at(window * parameters_.window + time, lane);
      const float wanted = (slot.value + slot.advantage) / static_cast<float>(kValueScale);
      const bool practised = slot.episode && !slot.episode->recorded;
      critic_.outputGradient(0)[place] = practised ? values[place] - wanted : 0.0f;
      steps += practised ? 1.0 : 0.0;
    }
  }
  critic_.backward(parameters, 1, gradient_);
  return steps;
}

}  // namespace lstm_planner
