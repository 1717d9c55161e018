#pragma once

#include <boost/program_options.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace lstm_planner {

// What the Q-learning trainings of the grid world (QLearningParameters) and of the robot (DriveQLearningParameters)
// have in common on the command line.

/// `parameters` hold the defaults and take the values. `unit`: of lengths; `update`: what the learner counts.
template <typename Parameters>
void addQLearningOptions(const std::string& unit, const std::string& update, Parameters* parameters,
                         boost::program_options::options_description* description) {
  namespace po = boost::program_options;
  Parameters& p = *parameters;
  const bool thesis = p.reward == Parameters::Reward::kThesis;
  // clang-format off
  description->add_options()
      ("discount", po::value(&p.discount)->default_value(p.discount), "a step (gamma)")
      ("trace-decay", po::value(&p.trace_decay)->default_value(p.trace_decay),
       "of returns that look further than one step (lambda); 0: one step")
      ("double-q", po::value(&p.double_q)->default_value(p.double_q),
       "1: the network that learns chooses the next action whose value the target network says; 0: the target network")
      ("target-interval", po::value(&p.target_interval)->default_value(p.target_interval),
       (update + " between copies of the weights into the target network").c_str())
      ("exploration-start", po::value(&p.exploration_start)->default_value(p.exploration_start),
       "share of actions at random (epsilon) at first")
      ("exploration-end", po::value(&p.exploration_end)->default_value(p.exploration_end), "and at last")
      ("exploration-share", po::value(&p.exploration_share)->default_value(p.exploration_share),
       ("of the " + update + ", after which it has sunk that far").c_str())
      ("reward", po::value<std::string>()->default_value(thesis ? "thesis" : "progress"),
       "progress (nearer to the goal by the true shortest way, less a cost) or thesis (Eq. 2.36)")
      ("step-cost", po::value(&p.step_cost)->default_value(p.step_cost), (unit + "; reward progress").c_str())
      ("arrival-bonus", po::value(&p.arrival_bonus)->default_value(p.arrival_bonus),
       (unit + "; reward progress").c_str())
      ("tau-range", po::value(&p.thesis_reward.range)->default_value(p.thesis_reward.range),
       ("cost of each range, times 1 " + unit + " / range; reward thesis").c_str())
      ("tau-distance", po::value(&p.thesis_reward.distance)->default_value(p.thesis_reward.distance),
       ("cost of the distance from the goal, for each " + unit + "; reward thesis").c_str())
      ("tau-angle", po::value(&p.thesis_reward.angle)->default_value(p.thesis_reward.angle),
       "cost of the angle to the goal, a rad; reward thesis")
      ("value-scale", po::value(&p.value_scale)->default_value(p.value_scale), "value that an output of 1 stands for")
      ("huber", po::value(&p.huber)->default_value(p.huber), "errors of values beyond it count by size, not square")
      ("rate", po::value(&p.learning_rate)->default_value(p.learning_rate), "learning rate");
  // clang-format on
}

/// Takes over what was parsed. Throws std::invalid_argument with a sentence for another reward.
template <typename Parameters>
void finishQLearningOptions(const boost::program_options::variables_map& values, Parameters* parameters) {
  const std::string reward = values["reward"].as<std::string>();
  if (reward != "progress" && reward != "thesis") {
    throw std::invalid_argument("--reward is '" + reward + "', expected progress or thesis");
  }
  parameters->reward = reward == "thesis" ? Parameters::Reward::kThesis : Parameters::Reward::kProgress;
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
