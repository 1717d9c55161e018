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

class RobotQLearner : public RobotLearner {
 public:
  RobotQLearner(const DriveQLearningParameters& parameters, LayerStack layers)
      : learner_(parameters, std::move(layers)) {}

  std::string columns() const override { return "iteration     steps   reward  arrival  epsilon    value    error"; }
  std::string iterate() override {
    const DriveQLearningReport report = learner_.iterate();
    std::ostringstream line;
    line << std::fixed << std::setw(9) << report.iteration << std::setprecision(0) << std::setw(10) << report.steps
         << std::setprecision(3) << std::setw(9) << report.reward << std::setw(9) << report.arrival << std::setw(9)
         << report.epsilon << std::setw(9) << report.value << std::setw(9) << report.error;
    return line.str();
  }
  int iterations() const override { return learner_.iterations(); }
  const LayerStack& layers() const override { return learner_.layers(); }
  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { learner_.restore(checkpoint); }

 private:
  DriveQLearning learner_;
};

bool readOptions(const std::vector<std::string>& arguments, RobotReinforcementPlan* plan,
                 DriveQLearningParameters* parameters) {
  DriveQLearningParameters& p = *parameters;
  CommandLine line("train --method q-learning", "the robot, by recurrent Q-learning in generated worlds");
  addRobotReinforcementOptions(arguments, plan, &p, &line);
  addQLearningOptions("m", "iterations", &p, &line);
  line.add("contact-cost", &p.contact_cost, {0.0, 1e6}, "m; reward progress");
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
  RobotQLearner learner(parameters, std::move(layers));
  return trainByReinforcement(plan, parameters.policy, parameters.iterations, &learner);
}

}  // namespace lstm_planner
