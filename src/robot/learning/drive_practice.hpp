#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "lstm_planner/base/common/communicator.hpp"
#include "lstm_planner/base/network/layers.hpp"
#include "lstm_planner/robot/driving/drive_policy.hpp"
#include "lstm_planner/robot/learning/drive_course.hpp"
#include "lstm_planner/robot/perception/encoder.hpp"
#include "lstm_planner/robot/perception/observation.hpp"

namespace lstm_planner {

/// What the critic sees besides the policy's inputs: the path left in two forms, how much longer than the straight path
/// it is, and where it starts.
constexpr int kDrivePrivilegedInputs = 5;

/// A drive as it was practised, step by step.
struct PracticeEpisode {
  struct Step {
    int action = 0;
    bool chosen = false;  ///< the action was drawn and carried out; otherwise there was nothing to choose
    float reward = 0.0f;
    float weight = 1.0f;  ///< how much a recorded step counts
  };
  std::size_t kind = 0;  ///< of world
  std::vector<Step> steps;
  std::vector<float> inputs;           ///< the encoder's (of the view ahead), then the privileged ones, step by step
  std::vector<ViewBearings> bearings;  ///< step by step; empty with one view
  std::vector<char> allowed;           ///< whether the shield allows the actions, step by step
  std::vector<float> probabilities;    ///< of the actions, 0 where the shield forbids one, step by step
  bool arrived = false;
  bool recorded = false;  ///< somebody's: the actions are to be learned, and nothing is known of rewards
};

/// Chooses the actions: fills in how likely each is to be drawn, up to a common factor. 0 where it is not allowed.
using ActionChances =
    std::function<void(const std::vector<float>& preferences, const std::vector<char>& allowed, float* chances)>;

/// By the network's preferences: their exponentials (softmax).
void preferredChances(const std::vector<float>& preferences, const std::vector<char>& allowed, float* chances);

/// The preferred action, but a share `epsilon` of them any.
ActionChances epsilonGreedyChances(double epsilon);

/// What a step brought.
struct PracticeOutcome {
  Observation before;     ///< in the state in which it started
  double approach = 0.0;  ///< m nearer to the goal by the teacher's path
  int contacts = 0;       ///< that started in it
};

/// What a step earns.
using PracticeReward = std::function<double(const PracticeOutcome& outcome)>;

/// What the step brings the robot nearer to the goal, less costs, m.
PracticeReward progressReward(double step_cost, double contact_cost);

/// How and where the drives go. What it calls is called by several threads at once.
struct PracticeRules {
  PolicyDescription policy;
  DriveCourseParameters course;
  int worlds = 1;         ///< an iteration
  int goals = 1;          ///< a world
  int starts = 1;         ///< drives to a goal
  int max_steps = 1;      ///< of a drive
  double discount = 0.0;  ///< a step; one of the privileged inputs is the path left, so discounted
  std::uint64_t seed = 1;
  int threads = 1;                            ///< does not change the result
  Communicator* communicator = oneProcess();  ///< does not change the result either
  ActionChances chances;
  PracticeReward reward;
  double arrival_bonus = 0.0;
};

/// From the parameters of a way of learning that have the same names.
template <typename Parameters>
PracticeRules practiceRules(const Parameters& parameters, ActionChances chances, PracticeReward reward,
                            double arrival_bonus) {
  return {parameters.policy,    parameters.course,   parameters.worlds, parameters.goals,   parameters.starts,
          parameters.max_steps, parameters.discount, parameters.seed,   parameters.threads, parameters.communicator,
          std::move(chances),   std::move(reward),   arrival_bonus};
}

/// All drives of iteration `iteration` (from 0) that had a step; the ranks share the worlds. Throws std::runtime_error
/// when there is none.
std::vector<PracticeEpisode> practise(const PracticeRules& rules, const LayerStack& layers, int iteration);

/// Of some drives.
struct PracticeSums {
  double steps = 0.0;
  double reward = 0.0;   ///< mean a drive
  double arrival = 0.0;  ///< share of the drives
};
PracticeSums sumUp(const std::vector<PracticeEpisode>& episodes);

}  // namespace lstm_planner
