#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/base/learning/q_learner.hpp"
#include "lstm_planner/robot/learning/drive_learner.hpp"
#include "lstm_planner/robot/perception/observation.hpp"

namespace lstm_planner {

/// The reward that the thesis quotes (Eq. 2.36), as ThesisRewardWeights reads it: r_i are the averages of the 8 sectors
/// (one below 0.1 m counts as 0.1 m), d is the straight distance to the goal, and theta the size of the goal's bearing.
/// The robot knows all of it itself, from its scanner and its odometry.
double driveThesisReward(const Observation& observation, const ThesisRewardWeights& weights);

/// Q-learning for the robot (thesis Eq. 2.34-2.39): a recurrent network whose outputs are the values of the steering
/// angles (Hausknecht and Stone, "Deep recurrent Q-learning for partially observable MDPs", 2015). What it learns from
/// are the practice drives of DriveActorCritic, with actions chosen epsilon-greedily among those that the shield
/// allows.
///
/// An iteration collects drives in new worlds and goes over them a few times, as QLearning goes over its windows, and
/// for the same reasons without a replay memory. The targets are worked out anew before each pass. A step in which
/// there was nothing to choose teaches no value; its reward counts for the steps before. Where a drive was cut off, the
/// value of what would have come next is unknown: its last step teaches nothing.
///
/// Lengths are in m, and an episode is a drive. The progress of a step counts 1 m at most.
struct DriveQLearningParameters : QLearningParameters, PracticeParameters {
  DriveQLearningParameters() {
    window = 32;
    reward = Reward::kThesis;
    thesis_reward.range = 0.03;
    step_cost = 0.05;
    arrival_bonus = 3.0;
    value_scale = 3.0;
    passes = 8;
  }
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const DriveQLearningParameters& parameters);

/// `layers` with weights to start from; learned ones prefer the action of the highest value: a DrivePolicy as they are.
/// Throws std::invalid_argument for what does not fit. An iteration throws std::runtime_error when no drive had a step.
std::unique_ptr<DriveLearner> makeDriveQLearning(const DriveQLearningParameters& parameters, LayerStack layers);

}  // namespace lstm_planner
