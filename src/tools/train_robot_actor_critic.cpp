#include <iomanip>
#include <sstream>
#include <utility>

#include "lstm_planner/learning/drive_actor_critic.hpp"
#include "tools/actor_critic_options.hpp"
#include "tools/options.hpp"
#include "tools/output_file.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_robot_reinforcement.hpp"

namespace lstm_planner {

namespace {

class RobotActorCritic : public RobotLearner {
 public:
  RobotActorCritic(const DriveActorCriticParameters& parameters, LayerStack layers)
      : learner_(parameters, std::move(layers)) {}

  std::string columns() const override { return "iteration     steps  reward  arrival  entropy  explained"; }
  std::string iterate() override {
    const DriveActorCriticReport report = learner_.iterate();
    std::ostringstream line;
    line << std::fixed << std::setw(9) << report.iteration << std::setprecision(0) << std::setw(10) << report.steps
         << std::setprecision(3) << std::setw(8) << report.reward << std::setw(9) << report.arrival << std::setw(9)
         << report.entropy << std::setw(11) << report.explained;
    return line.str();
  }
  int iterations() const override { return learner_.iterations(); }
  const LayerStack& layers() const override { return learner_.layers(); }
  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { learner_.restore(checkpoint); }

 private:
  DriveActorCritic learner_;
};

bool readOptions(const std::vector<std::string>& arguments, RobotReinforcementPlan* plan,
                 DriveActorCriticParameters* parameters) {
  namespace po = boost::program_options;
  DriveActorCriticParameters& p = *parameters;
  po::options_description description("the robot, by reinforcement: of a network that drives already, or of a new one");
  addRobotReinforcementOptions(plan, &p, &description);
  // clang-format off
  description.add_options()
      ("sharpness", po::value(&p.sharpness)->default_value(p.sharpness), "times the first network's preferences")
      ("clip", po::value(&p.clip)->default_value(p.clip), "how far a probability may change at once");
  // clang-format on
  addActorCriticOptions("m", &p, &description);
  po::variables_map values;
  if (!parseOptions("train", description, arguments, &values)) return false;
  finishRobotTrainingOptions(arguments, &plan->options);
  finishRobotNetwork(values, plan, &p.policy.encoder);
  if (plan->init.empty() && values["sharpness"].defaulted()) p.sharpness = 1.0;  // there is nothing to sharpen yet
  finishRobotReinforcement("actor-critic", plan, &p);
  plan->settings.update({{"sharpness", p.sharpness}, {"clip", p.clip}});
  plan->settings.update(actorCriticSettings(p));
  return true;
}

}  // namespace

int trainRobotByActorCritic(const std::vector<std::string>& arguments) {
  RobotReinforcementPlan plan;
  DriveActorCriticParameters parameters;
  if (!readOptions(arguments, &plan, &parameters)) return 0;
  LayerStack layers = firstLayers(plan, &parameters.policy);
  checkWritable(plan.options.output);
  RobotActorCritic learner(parameters, std::move(layers));
  return trainByReinforcement(plan, parameters.policy, parameters.iterations, &learner);
}

}  // namespace lstm_planner
