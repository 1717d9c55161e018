#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/base/common/communicator.hpp"
#include "lstm_planner/robot/driving/drive_policy.hpp"
#include "lstm_planner/robot/learning/drive_course.hpp"
#include "lstm_planner/robot/learning/drive_learner.hpp"
#include "lstm_planner/robot/perception/observation.hpp"

namespace lstm_planner {

/// Weights of the reward that the thesis quotes (Eq. 2.36), for the robot, read as ThesisRewardWeights says:
/// R(s) = -(tau_r sum(1 m / r_i) + tau_d d + tau_theta |theta|), every term a cost that ends with the arrival. r_i are
/// the averages of the 8 sectors (one below 0.1 m counts as 0.1 m), d is the straight distance to the goal, and theta
/// the goal's bearing, in [0, pi] by its size. All of it the robot knows itself, from its scanner and its odometry.
struct DriveThesisRewardWeights {
  double range = 0.03;     ///< tau_r, times 1 m / range, of each sector
  double distance = 0.02;  ///< tau_d, a metre
  double angle = 0.1;      ///< tau_theta, a rad
};

/// Of the state that is observed.
double driveThesisReward(const Observation& observation, const DriveThesisRewardWeights& weights);

/// Q-learning for the robot (thesis Eq. 2.34-2.39): a recurrent network whose outputs are the values of the steering
/// angles (Hausknecht and Stone, "Deep recurrent Q-learning for partially observable MDPs", 2015). What it learns from
/// are the practice drives of DriveActorCritic, with actions chosen epsilon-greedily among those that the shield
/// allows.
///
/// An iteration collects drives in new worlds and goes over them a few times, as QLearning goes over its windows, and
/// for the same reasons without a replay memory. The targets are worked out anew before each pass. A step in which
/// there was nothing to choose teaches no value; its reward counts for the steps before. Where a drive was cut off, the
/// value of what would have come next is unknown: its last step teaches nothing.
struct DriveQLearningParameters {
  enum class Reward {
    kProgress,  ///< m nearer to the goal by the teacher's path, 1 at most, less a cost a step, as DriveActorCritic
    kThesis,    ///< Eq. 2.36, of the state in which the step starts
  };
  PolicyDescription policy;
  DriveCourseParameters course;
  int iterations = 60;     ///< collect, then update
  int worlds = 16;         ///< an iteration, new ones each time
  int goals = 2;           ///< a world
  int starts = 8;          ///< drives to a goal
  int max_steps = 300;     ///< of a drive
  int window = 32;         ///< steps that errors go back at most
  int passes = 8;          ///< over what was collected
  double discount = 0.95;  ///< gamma, a step, in [0, 1)

  /// lambda in [0, 1] of returns that look further than one step, up to the next action that was not the best
  /// (Watkins's Q(lambda)); 0: one-step targets, Eq. 2.38.
  double trace_decay = 0.8;

  /// The best next action is chosen by the network that learns, its value read off the target network (van Hasselt et
  /// al., "Deep reinforcement learning with double Q-learning", AAAI 2016); off: both by the target network.
  bool double_q = true;
  int target_interval = 1;         ///< iterations between copies of the weights into the target network
  double exploration_start = 1.0;  ///< share of actions at random (epsilon), sinking linearly
  double exploration_end = 0.05;
  double exploration_share = 0.5;  ///< of the iterations, after which exploration_end is reached
  Reward reward = Reward::kThesis;
  DriveThesisRewardWeights thesis_reward;
  double step_cost = 0.05;     ///< m; kProgress only
  double arrival_bonus = 3.0;  ///< m; kProgress only
  double contact_cost = 0.5;   ///< m; kProgress only
  double value_scale = 3.0;    ///< an output of the network times this is a value, in the reward's unit
  double huber = 1.0;          ///< errors of values beyond it count by their size, not its square
  double learning_rate = 0.003;
  double max_gradient_norm = 0.5;
  std::uint64_t seed = 1;
  int threads = 2;                            ///< does not change the result
  Communicator* communicator = oneProcess();  ///< ranks that share the drives; does not change the result
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const DriveQLearningParameters& parameters);

/// Learns in place.
class DriveQLearning : public DriveLearner {
 public:
  /// `layers` with weights to start from. Throws std::invalid_argument for what does not fit.
  DriveQLearning(const DriveQLearningParameters& parameters, LayerStack layers);
  ~DriveQLearning() override;

  /// Throws std::runtime_error when no drive had a step.
  ReinforcementReport iterate() override;
  int updates() const override;
  const LayerStack& layers() const override;  ///< prefer the action of the highest value: a DrivePolicy as it is
  std::vector<std::uint8_t> checkpoint() const override;
  void restore(const std::vector<std::uint8_t>& checkpoint) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lstm_planner
