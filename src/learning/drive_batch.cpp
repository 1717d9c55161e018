#include "drive_batch.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {
namespace {

constexpr int kLanes = 64;

/// The critic's output times this is a return, m.
constexpr double kValueScale = 5.0;

/// Share of the way that the variances go towards those of one batch.
constexpr double kVarianceRate = 0.3;

}  // namespace

DriveBatch::DriveBatch(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic,
                       const std::vector<PracticeEpisode>& episodes)
    : parameters_(parameters),
      actions_(parameters.policy.actions.size()),
      policy_inputs_(inputSize(policy)),
      policy_(policy, kLanes, parameters.window),
      critic_(critic, kLanes * parameters.window, 1) {
  pack(episodes);
}

/// Each drive to the lane that is shortest so far.
void DriveBatch::pack(const std::vector<PracticeEpisode>& episodes) {
  std::vector<std::vector<Slot>> lanes(kLanes);
  for (const PracticeEpisode& episode : episodes) {
    auto& lane =
        *std::min_element(lanes.begin(), lanes.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
    for (std::size_t step = 0; step < episode.steps.size(); ++step) lane.push_back({&episode, step, 0.0f, 0.0f});
  }
  std::size_t longest = 0;
  for (const auto& lane : lanes) longest = std::max(longest, lane.size());
  windows_ = (static_cast<int>(longest) + parameters_.window - 1) / parameters_.window;
  slots_.resize(static_cast<std::size_t>(windows_ * parameters_.window * kLanes));
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto& own = lanes[static_cast<std::size_t>(lane)];
    for (std::size_t time = 0; time < own.size(); ++time) slotOf(static_cast<int>(time), lane) = own[time];
  }
}

DriveBatch::Slot& DriveBatch::slotOf(int time, int lane) {
  return slots_[static_cast<std::size_t>(time * kLanes + lane)];
}

void DriveBatch::fillInputs(const Slot& slot, int count, float* input, int stride) const {
  const auto all = static_cast<std::size_t>(policy_inputs_ + kDrivePrivilegedInputs);
  const float* values = slot.episode ? slot.episode->inputs.data() + slot.step * all : nullptr;
  for (int row = 0; row < count; ++row) input[row * stride] = values ? values[row] : 0.0f;
}

void DriveBatch::rewind() {
  window_ = -1;
  policy_.setState(std::vector<float>(policy_.state().size(), 0.0f));
}

bool DriveBatch::next() { return ++window_ < windows_; }

const float* DriveBatch::criticValues(const Eigen::VectorXf& parameters) {
  for (int time = 0; time < parameters_.window; ++time) {
    for (int lane = 0; lane < kLanes; ++lane) {
      fillInputs(slotOf(window_ * parameters_.window + time, lane), policy_inputs_ + kDrivePrivilegedInputs,
                 critic_.inputs(0) + time * kLanes + lane, critic_.lanes());
    }
  }
  return critic_.forward(parameters, 0);
}

void DriveBatch::judge(const Eigen::VectorXf& critic_parameters, std::vector<double>* advantage_variances) {
  window_ = -1;
  while (next()) {
    const float* values = criticValues(critic_parameters);
    for (int place = 0; place < kLanes * parameters_.window; ++place) {
      slots_[static_cast<std::size_t>(window_ * parameters_.window * kLanes + place)].value =
          static_cast<float>(kValueScale) * values[place];
    }
  }
  std::vector<double> squares(advantage_variances->size());
  std::vector<double> counts(advantage_variances->size());
  for (int lane = 0; lane < kLanes; ++lane) judgeLane(lane, &squares, &counts);
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    if (counts[kind] == 0.0) continue;
    double& variance = (*advantage_variances)[kind];
    variance += kVarianceRate * (squares[kind] / counts[kind] - variance);
  }
  double count = 0.0, sum = 0.0, squared = 0.0, errors = 0.0;
  for (const Slot& slot : slots_) {
    if (!slot.episode) continue;
    const double result = static_cast<double>(slot.value + slot.advantage);
    count += 1.0;
    sum += result;
    squared += result * result;
    errors += static_cast<double>(slot.advantage * slot.advantage);
  }
  explained_ = 1.0 - errors / std::max(1e-12, squared - sum * sum / count);
}

/// Advantages from the last step back.
void DriveBatch::judgeLane(int lane, std::vector<double>* squares, std::vector<double>* counts) {
  double next_value = 0.0;
  double advantage = 0.0;
  for (int time = windows_ * parameters_.window; time-- > 0;) {
    Slot& slot = slotOf(time, lane);
    if (!slot.episode) continue;
    const PracticeEpisode& episode = *slot.episode;
    const double value = static_cast<double>(slot.value);
    const bool last = slot.step + 1 == episode.steps.size();
    // A drive that is cut off would have gone on from much the same place.
    const double following = !last ? next_value : (episode.arrived ? 0.0 : value);
    const double error =
        static_cast<double>(episode.steps[slot.step].reward) + parameters_.discount * following - value;
    advantage = error + (last ? 0.0 : parameters_.discount * parameters_.advantage_decay * advantage);
    next_value = value;
    slot.advantage = static_cast<float>(advantage);
    (*squares)[episode.kind] += advantage * advantage;
    (*counts)[episode.kind] += 1.0;
  }
}

double DriveBatch::policyGradient(const Eigen::VectorXf& parameters, const DriveBatchWeights& weights,
                                  Eigen::VectorXf* gradient) {
  gradient->setZero(parameters.size());
  double chosen = 0.0;
  for (int time = 0; time < parameters_.window; ++time) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const Slot& slot = slotOf(window_ * parameters_.window + time, lane);
      if (slot.step == 0) policy_.forget(time, lane);
      fillInputs(slot, policy_inputs_, policy_.inputs(time) + lane, kLanes);
    }
    policy_.forward(parameters, time);
    for (int lane = 0; lane < kLanes; ++lane) {
      const Slot& slot = slotOf(window_ * parameters_.window + time, lane);
      for (int action = 0; action < actions_; ++action) policy_.outputGradient(time)[action * kLanes + lane] = 0.0f;
      if (!slot.episode || !slot.episode->steps[slot.step].chosen) continue;
      fillPolicyGradient(slot, time, lane, weights);
      chosen += 1.0;
    }
  }
  policy_.backward(parameters, parameters_.window, *gradient);
  policy_.carryOver(parameters_.window);
  return chosen;
}

/// Of -min(ratio * advantage, clipped ratio * advantage) - weight * entropy by the preferences.
void DriveBatch::fillPolicyGradient(const Slot& slot, int time, int lane, const DriveBatchWeights& weights) {
  const PracticeEpisode& episode = *slot.episode;
  const float* before = episode.probabilities.data() + slot.step * static_cast<std::size_t>(actions_);
  const float* preferences = policy_.outputs(time) + lane;
  float largest = -1e30f;
  for (int k = 0; k < actions_; ++k) {
    if (before[k] > 0.0f) largest = std::max(largest, preferences[k * kLanes]);
  }
  double total = 0.0;
  std::vector<double> now(static_cast<std::size_t>(actions_));
  for (int k = 0; k < actions_; ++k) {
    const auto i = static_cast<std::size_t>(k);
    now[i] = before[k] > 0.0f ? std::exp(static_cast<double>(preferences[k * kLanes] - largest)) : 0.0;
    total += now[i];
  }
  double entropy = 0.0;
  for (double& probability : now) {
    probability /= total;
    if (probability > 0.0) entropy -= probability * std::log(probability);
  }
  entropy_ += entropy;
  steps_seen_ += 1.0;
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
    policy_.outputGradient(time)[k * kLanes + lane] = static_cast<float>(slope);
  }
}

double DriveBatch::criticGradient(const Eigen::VectorXf& parameters, Eigen::VectorXf* gradient) {
  gradient->setZero(parameters.size());
  const float* values = criticValues(parameters);
  double steps = 0.0;
  for (int place = 0; place < kLanes * parameters_.window; ++place) {
    const Slot& slot = slots_[static_cast<std::size_t>(window_ * parameters_.window * kLanes + place)];
    const float wanted = (slot.value + slot.advantage) / static_cast<float>(kValueScale);
    critic_.outputGradient(0)[place] = slot.episode ? values[place] - wanted : 0.0f;
    steps += slot.episode ? 1.0 : 0.0;
  }
  critic_.backward(parameters, 1, *gradient);
  return steps;
}

}  // namespace lstm_planner
