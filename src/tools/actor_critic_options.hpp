#pragma once

#include <boost/program_options.hpp>
#include <nlohmann/json.hpp>

namespace lstm_planner {

// What the actor-critic trainings of the grid world (ActorCriticParameters) and of the robot
// (DriveActorCriticParameters) have in common on the command line.

/// `parameters` hold the defaults and take the values. `unit`: of costs and bonuses.
template <typename Parameters>
void addActorCriticOptions(const char* unit, Parameters* parameters,
                           boost::program_options::options_description* description) {
  namespace po = boost::program_options;
  Parameters& p = *parameters;
  // clang-format off
  description->add_options()
      ("critic", po::value(&p.critic_units)->multitoken(), "units of each of the critic's layers (default: 48 32)")
      ("discount", po::value(&p.discount)->default_value(p.discount), "a step")
      ("advantage-decay", po::value(&p.advantage_decay)->default_value(p.advantage_decay), "lambda")
      ("entropy-start", po::value(&p.entropy_start)->default_value(p.entropy_start), "weight of the entropy at first")
      ("entropy-end", po::value(&p.entropy_end)->default_value(p.entropy_end), "and at last")
      ("step-cost", po::value(&p.step_cost)->default_value(p.step_cost), unit)
      ("arrival-bonus", po::value(&p.arrival_bonus)->default_value(p.arrival_bonus), unit)
      ("rate", po::value(&p.learning_rate)->default_value(p.learning_rate), "learning rate")
      ("critic-rate", po::value(&p.critic_learning_rate)->default_value(p.critic_learning_rate), "of the critic");
  // clang-format on
}

/// What was given, by the options' names.
template <typename Parameters>
nlohmann::json actorCriticSettings(const Parameters& parameters) {
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
