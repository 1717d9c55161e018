#include <stdexcept>
#include <utility>

#include "lstm_planner/learning/q_learning.hpp"
#include "tools/options.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_grid_reinforcement.hpp"

namespace lstm_planner {

namespace {

class QLearner : public ReinforcementLearner {
 public:
  QLearner(const QLearningParameters& parameters, LayerStack layers) : learner_(parameters, std::move(layers)) {}

  void beginEpoch(int epoch, const GridCourse& course) override { learner_.beginEpoch(epoch, course); }
  void update() override { learner_.update(); }
  ReinforcementReport report() override {
    const QLearningReport report = learner_.report();
    return {report.steps, report.reward, report.arrival, report.ratio};
  }
  const LayerStack& layers() const override { return learner_.layers(); }
  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { learner_.restore(checkpoint); }

 private:
  QLearning learner_;
};

QLearningParameters::Reward rewardNamed(const std::string& name) {
  if (name == "progress") return QLearningParameters::Reward::kProgress;
  if (name == "thesis") return QLearningParameters::Reward::kThesis;
  throw std::invalid_argument("--reward is '" + name + "', expected progress or thesis");
}

void addQLearningOptions(QLearningParameters* parameters, boost::program_options::options_description* description) {
  namespace po = boost::program_options;
  QLearningParameters& p = *parameters;
  // clang-format off
  description->add_options()
      ("agents", po::value(&p.agents)->default_value(p.agents), "at a time")
      ("window", po::value(&p.window)->default_value(p.window), "steps of each agent an update")
      ("max-steps", po::value(&p.max_steps)->default_value(p.max_steps), "of a training episode")
      ("discount", po::value(&p.discount)->default_value(p.discount), "a step (gamma)")
      ("trace-decay", po::value(&p.trace_decay)->default_value(p.trace_decay),
       "of returns that look further than one step (lambda); 0: one step")
      ("double-q", po::value(&p.double_q)->default_value(p.double_q),
       "1: the network that learns chooses the next move whose value the target network says; 0: the target network")
      ("target-interval", po::value(&p.target_interval)->default_value(p.target_interval),
       "updates between copies of the weights into the target network")
      ("exploration-start", po::value(&p.exploration_start)->default_value(p.exploration_start),
       "share of moves at random (epsilon) at first")
      ("exploration-end", po::value(&p.exploration_end)->default_value(p.exploration_end), "and at last")
      ("exploration-share", po::value(&p.exploration_share)->default_value(p.exploration_share),
       "of the updates, after which it has sunk that far")
      ("reward", po::value<std::string>()->default_value("progress"),
       "progress (nearer to the goal by the true shortest way, less a cost) or thesis (Eq. 2.36)")
      ("step-cost", po::value(&p.step_cost)->default_value(p.step_cost), "cells; reward progress")
      ("arrival-bonus", po::value(&p.arrival_bonus)->default_value(p.arrival_bonus), "cells; reward progress")
      ("tau-range", po::value(&p.thesis_reward.range)->default_value(p.thesis_reward.range),
       "cost of each ray times 1 / range; reward thesis")
      ("tau-distance", po::value(&p.thesis_reward.distance)->default_value(p.thesis_reward.distance),
       "a cell from the goal; reward thesis")
      ("tau-angle", po::value(&p.thesis_reward.angle)->default_value(p.thesis_reward.angle),
       "a rad between the move before and the goal; reward thesis")
      ("value-scale", po::value(&p.value_scale)->default_value(p.value_scale), "value that an output of 1 stands for")
      ("huber", po::value(&p.huber)->default_value(p.huber), "errors of values beyond it count by size, not square")
      ("rate", po::value(&p.learning_rate)->default_value(p.learning_rate), "learning rate");
  // clang-format on
}

nlohmann::json settingsOf(const QLearningParameters& p, const std::string& reward) {
  return {{"agents", p.agents},
          {"window", p.window},
          {"max-steps", p.max_steps},
          {"discount", p.discount},
          {"trace-decay", p.trace_decay},
          {"double-q", p.double_q},
          {"target-interval", p.target_interval},
          {"exploration-start", p.exploration_start},
          {"exploration-end", p.exploration_end},
          {"exploration-share", p.exploration_share},
          {"reward", reward},
          {"step-cost", p.step_cost},
          {"arrival-bonus", p.arrival_bonus},
          {"tau-range", p.thesis_reward.range},
          {"tau-distance", p.thesis_reward.distance},
          {"tau-angle", p.thesis_reward.angle},
          {"value-scale", p.value_scale},
          {"huber", p.huber},
          {"rate", p.learning_rate}};
}

bool readOptions(const std::vector<std::string>& arguments, ReinforcementPlan* plan, QLearningParameters* learner) {
  namespace po = boost::program_options;
  GridTrainingOptions& options = plan->options;
  QLearningParameters& p = *learner;
  options.method = "q-learning";
  options.epochs = 10;
  options.encoder = p.encoder;
  plan->updates = p.updates;
  po::options_description description("a network for the grid world, by recurrent Q-learning");
  addGridTrainingOptions(&options, &description);
  addReinforcementOptions(plan, &description);
  addQLearningOptions(&p, &description);
  po::variables_map values;
  if (!parseOptions("train", description, arguments, &values)) return false;
  finishGridTrainingOptions(values, arguments, &options);
  finishReinforcementOptions(plan);
  const std::string reward = values["reward"].as<std::string>();
  p.reward = rewardNamed(reward);
  p.updates = plan->updates;
  p.seed = options.seed;
  p.threads = options.threads;
  p.communicator = ranks();
  validate(p);
  plan->settings.update(settingsOf(p, reward));
  return true;
}

}  // namespace

int trainGridByQLearning(const std::vector<std::string>& arguments) {
  ReinforcementPlan plan;
  QLearningParameters parameters;
  if (!readOptions(arguments, &plan, &parameters)) return 0;
  LayerStack layers = firstLayers(&plan.options);
  parameters.encoder = plan.options.encoder;
  QLearner learner(parameters, std::move(layers));
  return trainByReinforcement(plan, &learner);
}

}  // namespace lstm_planner
