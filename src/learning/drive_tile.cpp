#include "drive_tile.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {
namespace {

/// The critic's output times this is a return, m.
constexpr double kValueScale = 5.0;

}  // namespace

DriveTile::DriveTile(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic)
    : parameters_(parameters),
      actions_(parameters.policy.actions.size()),
      policy_inputs_(inputSize(policy)),
      views_(parameters.policy.encoder.views),
      drive_lanes_(lanesFor(parameters)),
      encoder_(parameters.policy.encoder),
      policy_(policy, drive_lanes_ * views_, parameters.window),
      critic_(critic, drive_lanes_ * parameters.window, 1),
      lanes_(static_cast<std::size_t>(drive_lanes_)) {
  if (views_ != 1) action_views_ = viewsOf(parameters.policy.actions);
}

std::size_t DriveTile::shortestLane() const {
  const auto shorter = [](const auto& a, const auto& b) { return a.size() < b.size(); };
  return static_cast<std::size_t>(std::min_element(lanes_.begin(), lanes_.end(), shorter) - lanes_.begin());
}

std::size_t DriveTile::longest() const {
  std::size_t longest = 0;
  for (const auto& lane : lanes_) longest = std::max(longest, lane.size());
  return longest;
}

void DriveTile::append(std::size_t lane, const PracticeEpisode& episode) {
  for (std::size_t step = 0; step < episode.steps.size(); ++step) lanes_[lane].push_back({&episode, step, 0.0f, 0.0f});
}

void DriveTile::close(int windows) {
  windows_ = windows;
  for (auto& lane : lanes_) lane.resize(static_cast<std::size_t>(windows * parameters_.window));
}

DriveSlot& DriveTile::slotOf(int time, int lane) {
  return lanes_[static_cast<std::size_t>(lane)][static_cast<std::size_t>(time)];
}

/// Null where there is no drive.
const float* DriveTile::inputsOf(const DriveSlot& slot) const {
  const auto all = static_cast<std::size_t>(policy_inputs_ + kDrivePrivilegedInputs);
  return slot.episode ? slot.episode->inputs.data() + slot.step * all : nullptr;
}

/// Rows of one slot's inputs into those of a network: the first `count`, `stride` apart.
void DriveTile::fillInputs(const DriveSlot& slot, int count, float* input, int stride) const {
  const float* values = inputsOf(slot);
  for (int row = 0; row < count; ++row) input[row * stride] = values ? values[row] : 0.0f;
}

void DriveTile::fillPolicyInputs(const DriveSlot& slot, int time, int lane) {
  float* first = policy_.inputs(time) + lane * views_;
  if (views_ == 1 || !slot.episode) {
    for (int view = 0; view < views_; ++view) fillInputs(slot, policy_inputs_, first + view, policy_.lanes());
    return;
  }
  const ViewBearings& bearings = slot.episode->bearings[slot.step];
  for (int view = 0; view < views_; ++view) {
    const int direction = (bearings.ahead + view) % views_;
    encoder_.turn(inputsOf(slot), bearings, view, first + direction, policy_.lanes());
  }
}

/// Where an action's preference lies among the policy's outputs; the slot must have a drive.
int DriveTile::preferenceAt(const DriveSlot& slot, int lane, int action) const {
  if (views_ == 1) return action * policy_.lanes() + lane;
  const int ahead = slot.episode->bearings[slot.step].ahead;
  return lane * views_ + (ahead + action_views_[static_cast<std::size_t>(action)]) % views_;
}

void DriveTile::rewind() { policy_.setState(std::vector<float>(policy_.state().size(), 0.0f)); }

const float* DriveTile::criticValues(int window, const Eigen::VectorXf& parameters) {
  for (int time = 0; time < parameters_.window; ++time) {
    for (int lane = 0; lane < drive_lanes_; ++lane) {
      fillInputs(slotOf(window * parameters_.window + time, lane), policy_inputs_ + kDrivePrivilegedInputs,
                 critic_.inputs(0) + time * drive_lanes_ + lane, critic_.lanes());
    }
  }
  return critic_.forward(parameters, 0);
}

DriveTileSums DriveTile::judge(const Eigen::VectorXf& critic_parameters) {
  for (int window = 0; window < windows_; ++window) {
    const float* values = criticValues(window, critic_parameters);
    for (int time = 0; time < parameters_.window; ++time) {
      for (int lane = 0; lane < drive_lanes_; ++lane) {
        slotOf(window * parameters_.window + time, lane).value =
            static_cast<float>(kValueScale) * values[time * drive_lanes_ + lane];
      }
    }
  }
  DriveTileSums sums;
  sums.squares.resize(parameters_.course.worlds.size());
  sums.counts.resize(parameters_.course.worlds.size());
  for (int lane = 0; lane < drive_lanes_; ++lane) judgeLane(lane, &sums);
  return sums;
}

/// Advantages from the last step back.
void DriveTile::judgeLane(int lane, DriveTileSums* sums) {
  double next_value = 0.0;
  double advantage = 0.0;
  for (int time = windows_ * parameters_.window; time-- > 0;) {
    DriveSlot& slot = slotOf(time, lane);
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
    for (int lane = 0; lane < drive_lanes_; ++lane) {
      const DriveSlot& slot = slotOf(window * parameters_.window + time, lane);
      for (int view = 0; slot.step == 0 && view < views_; ++view) policy_.forget(time, lane * views_ + view);
      fillPolicyInputs(slot, time, lane);
    }
    policy_.forward(parameters, time);
    std::fill_n(policy_.outputGradient(time), policy_.outputSize() * policy_.lanes(), 0.0f);
    for (int lane = 0; lane < drive_lanes_; ++lane) {
      const DriveSlot& slot = slotOf(window * parameters_.window + time, lane);
      if (!slot.episode || !slot.episode->steps[slot.step].chosen) continue;
      fillPolicyGradient(slot, time, lane, weights);
      chosen += 1.0;
    }
  }
  policy_.backward(parameters, parameters_.window, gradient_);
  policy_.carryOver(parameters_.window);
  return chosen;
}

/// Of -min(ratio * advantage, clipped ratio * advantage) - weight * entropy by the preferences.
void DriveTile::fillPolicyGradient(const DriveSlot& slot, int time, int lane, const DriveBatchWeights& weights) {
  const PracticeEpisode& episode = *slot.episode;
  const float* before = episode.probabilities.data() + slot.step * static_cast<std::size_t>(actions_);
  const float* preferences = policy_.outputs(time);
  float largest = -1e30f;
  for (int k = 0; k < actions_; ++k) {
    if (before[k] > 0.0f) largest = std::max(largest, preferences[preferenceAt(slot, lane, k)]);
  }
  double total = 0.0;
  std::vector<double> now(static_cast<std::size_t>(actions_));
  for (int k = 0; k < actions_; ++k) {
    const auto i = static_cast<std::size_t>(k);
    now[i] = before[k] > 0.0f ? std::exp(static_cast<double>(preferences[preferenceAt(slot, lane, k)] - largest)) : 0.0;
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
    policy_.outputGradient(time)[preferenceAt(slot, lane, k)] = static_cast<float>(slope);
  }
}

double DriveTile::criticGradient(int window, const Eigen::VectorXf& parameters) {
  gradient_.setZero(parameters.size());
  const float* values = criticValues(window, parameters);
  double steps = 0.0;
  for (int time = 0; time < parameters_.window; ++time) {
    for (int lane = 0; lane < drive_lanes_; ++lane) {
      const int place = time * drive_lanes_ + lane;
      const DriveSlot& slot = slotOf(window * parameters_.window + time, lane);
      const float wanted = (slot.value + slot.advantage) / static_cast<float>(kValueScale);
      critic_.outputGradient(0)[place] = slot.episode ? values[place] - wanted : 0.0f;
      steps += slot.episode ? 1.0 : 0.0;
    }
  }
  critic_.backward(parameters, 1, gradient_);
  return steps;
}

}  // namespace lstm_planner
