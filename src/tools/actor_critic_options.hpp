#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lstm_planner/base/learning/actor_critic.hpp"
#include "tools/command_line.hpp"
#include "tools/ranges.hpp"

namespace lstm_planner {

// What the actor-critic trainings of the grid world and of the robot have in common on the command line.

/// `parameters` hold the defaults and take the values. `unit`: of costs and bonuses.
inline void addActorCriticOptions(const std::string& unit, ActorCriticParameters* parameters, CommandLine* line) {
  ActorCriticParameters& p = *parameters;
  line->add("critic", &p.critic_units, kAnyLayer, "units of each layer of the critic");
  line->add("discount", &p.discount, kAnyShare, "discount factor per step (gamma)");
  line->add("advantage-decay", &p.advantage_decay, kAnyShare, "decay of the advantage estimate (lambda)");
  line->add("entropy-start", &p.entropy_start, kAnyWeight, "weight of the entropy at the start");
  line->add("entropy-end", &p.entropy_end, kAnyWeight, "weight of the entropy at the end");
  line->add("step-cost", &p.step_cost, kAnyReward, unit);
  line->add("arrival-bonus", &p.arrival_bonus, kAnyReward, unit);
  line->add("rate", &p.learning_rate, kAnyRate, "learning rate");
  line->add("critic-rate", &p.critic_learning_rate, kAnyRate, "learning rate of the critic");
}

/// What was given, by the options' names.
inline nlohmann::json actorCriticSettings(const ActorCriticParameters& parameters) {
  return {{"critic", parameters.critic_units},
          {"discount", parameters.discount},
          {"advantage-decay", parameters.advantage_decay},
          {"entropy-start", parameters.entropy_start},
          {"entropy-end", parameters.entropy_end},
          {"step-cost", parameters.step_cost},
          {"arrival-bonus", parameters.arrival_bonus},
          {"rate", parameters.learning_rate},
          {"critic-rate", parameters.critic_learning_rate}};
}

}  // namespace lstm_planner
