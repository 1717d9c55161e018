#include <string>
#include <utility>

#include "lstm_planner/robot/learning/drive_q_learning.hpp"
#include "tools/q_learning_options.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_robot_reinforcement.hpp"

namespace lstm_planner {

namespace {

const char* const kQLearningColumns = "iteration     steps   reward  arrival  epsilon    value    error";

std::vector<std::string> qLearningCells(const ReinforcementReport& report) {
  return {std::to_string(report.update), fixedText(report.steps, 0),   fixedText(report.reward, 3),
          fixedText(report.arrival, 3),  fixedText(report.epsilon, 3), fixedText(report.value, 3),
          fixedText(report.error, 3)};
}

bool readOptions(const std::vector<std::string>& arguments, RobotReinforcementPlan* plan,
                 DriveQLearningParameters* parameters) {
  DriveQLearningParameters& p = *parameters;
  CommandLine line("train --method q-learning",
                   "trains a network for the robot by recurrent Q-learning in generated worlds");
  addRobotReinforcementOptions(arguments, plan, &p, &line);
  addRewardOption(&p.reward, &line);
  visitQLearningParameters(p, "m", "iterations", line.everyParameter());
  if (!line.parse(arguments)) return false;
  finishRobotReinforcement("q-learning", plan, &p);
  plan->settings["reward"] = nameOf(p.reward, rewards());
  visitQLearningParameters(p, "m", "iterations", noteIn(&plan->settings));
  validate(p);
  return true;
}

}  // namespace

int trainRobotByQLearning(const std::vector<std::string>& arguments) {
  RobotReinforcementPlan plan;
  DriveQLearningParameters parameters;
  if (!readOptions(arguments, &plan, &parameters)) return 0;
  LayerStack layers = firstLayers(plan, &parameters.policy);
  const auto learner = makeDriveQLearning(parameters, std::move(layers));
  return trainByReinforcement(plan, parameters.policy, parameters.iterations,
                              {TextTable(kQLearningColumns), qLearningCells}, learner.get());
}

}  // namespace lstm_planner
