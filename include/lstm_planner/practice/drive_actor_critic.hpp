#pragma once

#include <memory>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/practice/drive_course.hpp"
#include "lstm_planner/training/actor_critic.hpp"
#include "lstm_planner/training/training_loop.hpp"

namespace lstm_planner {

/// Reinforcement for the robot: an actor with a critic that knows more (distances that are known only in generated
/// worlds), generalised advantages, and updates that stay near the policy that drove (Schulman et al., "Proximal policy
/// optimization algorithms", 2017). Drives are those of StepSimulator, under random conditions. The reward of a step is
/// how much shorter the teacher's path to the goal has become, minus a cost.
///
/// Lengths are in m, and an episode is a drive.
struct DriveActorCriticParameters : ActorCriticParameters {
  PolicyDescription policy;
  DriveCourseParameters course;
  int iterations = 60;       ///< collect, then update
  int judgements = 10;       ///< approximate number after the first one; at most the number of iterations
  int worlds = 16;           ///< per iteration, new ones each time
  int goals = 2;             ///< per world
  int starts = 8;            ///< drives per goal
  double path_share = 0.0;   ///< share of drives that are examples of following the remembered path, under the bound
  double path_weight = 1.0;  ///< of a step of these; a practised step has 1
  double sharpness = 3.0;  ///< factor on the first policy's preferences: after imitation they are too close for drawing
};

/// Visits the parameters of the practice that have an option, by the option's name; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitPracticeParameters(Parameters& p, const Visitor& visit) {
  visit("iterations", p.iterations, {1, 1e6}, "", "iterations of collecting drives and learning");
  visit("worlds", p.worlds, {1, 1e5}, "", "worlds per iteration");
  visit("goals", p.goals, {1, 1e4}, "", "goals per world");
  visit("starts", p.starts, {1, 1e4}, "", "drives per goal");
  visit("window", p.window, {1, 1e5}, "", "largest number of steps of backpropagation through time");
  visit("path-share", p.path_share, {0.0, 1.0}, "",
        "share of the drives in which obstacles are remembered, and the network learns to choose the remembered path");
  visit("path-weight", p.path_weight, {0.0, 1e6}, "", "weight of a step of these drives; a practised step has 1");
  visit("sharpness", p.sharpness, {1e-9, 1e9}, "", "factor on the preferences of the network of --init");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const DriveActorCriticParameters& parameters);

/// What the robot did in an iteration.
struct ReinforcementReport {
  int update = 0;          ///< number of the iteration, from 1
  double steps = 0.0;      ///< of all drives since the start
  double reward = 0.0;     ///< mean of a drive, m
  double arrival = 0.0;    ///< share of the drives
  double entropy = 0.0;    ///< mean, nat
  double explained = 0.0;  ///< share of the returns' variance that the critic explains
};

/// The robot's network, while it learns by reinforcement: a step is an iteration, which collects drives and learns from
/// them. What happens in it depends only on the weights, the seed, and how many iterations there were before. The
/// network is judged before the first iteration, after the last, and in between.
class DriveActorCritic : public SteppedTraining {
 public:
  /// From now on each iteration also learns to steer as the driver of these drives did (cross-entropy; rare angles
  /// weigh more). `weight`: that of the mean over the recorded steps; the mean over the practised steps has 1. So a
  /// network that can drive learns somebody's style without forgetting how to arrive. Throws std::invalid_argument
  /// unless the weight is positive, there are steps, and the recordings fit the policy.
  virtual void follow(const Dataset& recordings, double weight) = 0;

  virtual const ReinforcementReport& report() const = 0;  ///< of the last iteration
  virtual int iterations() const = 0;                     ///< done so far
};

/// `layers` are the policy's, with the weights to start from. Throws std::invalid_argument if something does not fit.
std::unique_ptr<DriveActorCritic> makeDriveActorCritic(const DriveActorCriticParameters& parameters, LayerStack layers);

}  // namespace lstm_planner
