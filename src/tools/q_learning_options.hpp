#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lstm_planner/base/learning/q_learner.hpp"
#include "tools/command_line.hpp"
#include "tools/ranges.hpp"

namespace lstm_planner {

// What the Q-learning trainings of the grid world and of the robot have in common on the command line.

/// `parameters` hold the defaults and take the values. `unit`: of lengths; `update`: what the learner counts.
inline void addQLearningOptions(const std::string& unit, const std::string& update, QLearningParameters* parameters,
                                CommandLine* line) {
  using Reward = QLearningParameters::Reward;
  QLearningParameters& p = *parameters;
  line->add("discount", &p.discount, kAnyShare, "discount factor per step (gamma)");
  line->add("trace-decay", &p.trace_decay, kAnyShare, "decay of the returns over several steps (lambda); 0: one step");
  line->add("double-q", &p.double_q,
            "1: double Q-learning: the learning network chooses the next action, and the target network gives its "
            "value; 0: the target network does both");
  line->add("target-interval", &p.target_interval, kAnySteps,
            update + " between copies of the weights into the target network");
  line->add("exploration-start", &p.exploration_start, kAnyShare, "share of random actions (epsilon) at the start");
  line->add("exploration-end", &p.exploration_end, kAnyShare, "share of random actions at the end");
  line->add("exploration-share", &p.exploration_share, kAnyShare,
            "share of the " + update + " after which epsilon has its last value");
  line->addChoice(
      "reward", &p.reward, {{"progress", Reward::kProgress}, {"thesis", Reward::kThesis}},
      "progress (how much shorter the true shortest path to the goal has become, minus a cost) or thesis (Eq. 2.36)");
  line->add("step-cost", &p.step_cost, kAnyReward, unit + "; for --reward progress");
  line->add("arrival-bonus", &p.arrival_bonus, kAnyReward, unit + "; for --reward progress");
  line->add("tau-range", &p.thesis_reward.range, kAnyReward,
            "cost of each range, times 1 " + unit + " / range; for --reward thesis");
  line->add("tau-distance", &p.thesis_reward.distance, kAnyReward,
            "cost of the distance from the goal, for each " + unit + "; for --reward thesis");
  line->add("tau-angle", &p.thesis_reward.angle, kAnyReward,
            "cost of the angle to the goal, for each rad; for --reward thesis");
  line->add("value-scale", &p.value_scale, kAnyScale, "factor from an output of the network to a value");
  line->add("huber", &p.huber, kAnyScale, "limit of the Huber loss: larger errors count linearly, not by their square");
  line->add("rate", &p.learning_rate, kAnyRate, "learning rate");
}

/// What was given, by the options' names.
inline nlohmann::json qLearningSettings(const QLearningParameters& p) {
  return {{"discount", p.discount},
          {"trace-decay", p.trace_decay},
          {"double-q", p.double_q},
          {"target-interval", p.target_interval},
          {"exploration-start", p.exploration_start},
          {"exploration-end", p.exploration_end},
          {"exploration-share", p.exploration_share},
          {"reward", p.reward == QLearningParameters::Reward::kThesis ? "thesis" : "progress"},
          {"step-cost", p.step_cost},
          {"arrival-bonus", p.arrival_bonus},
          {"tau-range", p.thesis_reward.range},
          {"tau-distance", p.thesis_reward.distance},
          {"tau-angle", p.thesis_reward.angle},
          {"value-scale", p.value_scale},
          {"huber", p.huber},
          {"rate", p.learning_rate}};
}

}  // namespace lstm_planner
