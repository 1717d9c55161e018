#include <iomanip>
#include <sstream>
#include <utility>

#include "lstm_planner/robot/learning/drive_q_learning.hpp"
#include "tools/q_learning_options.hpp"
#include "tools/ranges.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_robot_reinforcement.hpp"

namespace lstm_planner {

namespace {

const char* const kColumns = "iteration     steps   reward  arrival  epsilon    value    error";

std::string lineOf(const ReinforcementReport& report) {
  std::ostringstream line;
  line << std::fixed << std::setw(9) << report.update << std::setprecision(0) << std::setw(10) << report.steps
       << std::setprecision(3) << std::setw(9) << report.reward << std::setw(9) << report.arrival << std::setw(9)
       << report.epsilon << std::setw(9) << report.value << std::setw(9) << report.error;
  return line.str();
}

bool readOptions(const std::vector<std::string>& arguments, RobotReinforcementPlan* plan,
                 DriveQLearningParameters* parameters) {
  DriveQLearningParameters& p = *parameters;
  CommandLine line("train --method q-learning",
                   "trains a network for the robot by recurrent Q-learning in generated worlds");
  addRobotReinforcementOptions(arguments, plan, &p, &line);
  addQLearningOptions("m", "iterations", &p, &line);
  line.add("contact-cost", &p.contact_cost, {0.0, 1e6}, "m; for --reward progress");
  if (!line.parse(arguments)) return false;
  finishRobotReinforcement("q-learning", plan, &p);
  plan->settings.update(qLearningSettings(p));
  plan->settings["contact-cost"] = p.contact_cost;
  validate(p);
  return true;
}

}  // namespace

int trainRobotByQLearning(const std::vector<std::string>& arguments) {
  RobotReinforcementPlan plan;
  DriveQLearningParameters parameters;
  if (!readOptions(arguments, &plan, &parameters)) return 0;
  LayerStack layers = firstLayers(plan, &parameters.policy);
  DriveQLearning learner(parameters, std::move(layers));
  return trainByReinforcement(plan, parameters.policy, parameters.iterations, {kColumns, lineOf}, &learner);
}

}  // namespace lstm_planner
