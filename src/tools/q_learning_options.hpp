#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tools/command_line.hpp"
#include "tools/ranges.hpp"

namespace lstm_planner {

// What the Q-learning trainings of the grid world (GridQLearningParameters) and of the robot (DriveQLearningParameters)
// have in common on the command line.

/// `parameters` hold the defaults and take the values. `unit`: of lengths; `update`: what the learner counts.
template <typename Parameters>
void addQLearningOptions(const std::string& unit, const std::string& update, Parameters* parameters,
                         CommandLine* line) {
  using Reward = typename Parameters::Reward;
  Parameters& p = *parameters;
  line->add("discount", &p.discount, kAnyShare, "a step (gamma)");
  line->add("trace-decay", &p.trace_decay, kAnyShare,
            "of returns that look further than one step (lambda); 0: one step");
  line->add("double-q", &p.double_q,
            "1: the network that learns chooses the next action whose value the target network says; 0: the target "
            "network");
  line->add("target-interval", &p.target_interval, kAnySteps,
            update + " between copies of the weights into the target network");
  line->add("exploration-start", &p.exploration_start, kAnyShare, "share of actions at random (epsilon) at first");
  line->add("exploration-end", &p.exploration_end, kAnyShare, "and at last");
  line->add("exploration-share", &p.exploration_share, kAnyShare,
            "of the " + update + ", after which it has sunk that far");
  line->addChoice("reward", &p.reward, {{"progress", Reward::kProgress}, {"thesis", Reward::kThesis}},
                  "progress (nearer to the goal by the true shortest path, less a cost) or thesis (Eq. 2.36)");
  line->add("step-cost", &p.step_cost, kAnyReward, unit + "; reward progress");
  line->add("arrival-bonus", &p.arrival_bonus, kAnyReward, unit + "; reward progress");
  line->add("tau-range", &p.thesis_reward.range, kAnyReward,
            "cost of each range, times 1 " + unit + " / range; reward thesis");
  line->add("tau-distance", &p.thesis_reward.distance, kAnyReward,
            "cost of the distance from the goal, for each " + unit + "; reward thesis");
  line->add("tau-angle", &p.thesis_reward.angle, kAnyReward, "cost of the angle to the goal, a rad; reward thesis");
  line->add("value-scale", &p.value_scale, kAnyScale, "value that an output of 1 stands for");
  line->add("huber", &p.huber, kAnyScale, "errors of values beyond it count by size, not square");
  line->add("rate", &p.learning_rate, kAnyRate, "learning rate");
}

/// What was given, by the options' names.
template <typename Parameters>
nlohmann::json qLearningSettings(const Parameters& p) {
  return {{"discount", p.discount},
          {"trace-decay", p.trace_decay},
          {"double-q", p.double_q},
          {"target-interval", p.target_interval},
          {"exploration-start", p.exploration_start},
          {"exploration-end", p.exploration_end},
          {"exploration-share", p.exploration_share},
          {"reward", p.reward == Parameters::Reward::kThesis ? "thesis" : "progress"},
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
