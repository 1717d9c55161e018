#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/practice/drive_learner.hpp"
#include "lstm_planner/training/actor_critic.hpp"

namespace lstm_planner {

/// Reinforcement for the robot: an actor with a critic that sees more (distances that are known in generated worlds
/// only), generalised advantages, and updates that stay near the policy that drove (Schulman et al., "Proximal policy
/// optimization algorithms", 2017). Drives are StepSimulator's, under random conditions. The reward of a step is what
/// it brings the robot nearer to the goal by the teacher's path, less a cost.
///
/// Lengths are in m, and an episode is a drive.
struct DriveActorCriticParameters : ActorCriticParameters, PracticeParameters {
  DriveActorCriticParameters() {
    window = 32;
    entropy_start = 0.003;
    entropy_end = 0.0003;
    step_cost = 0.05;
    arrival_bonus = 3.0;
    learning_rate = 0.002;
    critic_learning_rate = 0.005;
  }

  double sharpness = 3.0;  ///< times the first policy's preferences, which imitation leaves too close for drawing
  double clip = 0.2;       ///< how far from 1 a probability's change still counts
};

/// Visits what is its own and has an option, named as it; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitPolicyChangeParameters(Parameters& p, const Visitor& visit) {
  visit("sharpness", p.sharpness, {1e-9, 1e9}, "", "factor on the preferences of the network of --init");
  visit("clip", p.clip, {1e-9, 1e9}, "", "largest change of a probability in an update (PPO's clip)");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const DriveActorCriticParameters& parameters);

class DriveActorCritic : public DriveLearner {
 public:
  /// From now on each iteration also learns to steer as the driver of these drives did (cross-entropy, rare angles
  /// weigh more), with the `weight` that the mean over the recorded steps has beside the mean over the practised ones.
  /// So a network that drives can take over somebody's manner without forgetting how to arrive. Throws
  /// std::invalid_argument unless the weight is positive, there are steps, and the recordings fit the policy.
  virtual void follow(const Dataset& recordings, double weight) = 0;
};

/// `layers` are the policy's, with weights to start from. Throws std::invalid_argument for what does not fit.
std::unique_ptr<DriveActorCritic> makeDriveActorCritic(const DriveActorCriticParameters& parameters, LayerStack layers);

}  // namespace lstm_planner
