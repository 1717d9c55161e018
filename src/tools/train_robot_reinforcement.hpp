#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/practice/drive_learner.hpp"
#include "tools/ranks.hpp"
#include "tools/train_robot_options.hpp"
#include "tools/visited_settings.hpp"

namespace lstm_planner {

/// The table of iterations that a way of learning prints.
struct RobotLearningTable {
  TextTable table;
  std::function<std::vector<std::string>(const ReinforcementReport&)> cells;
  std::function<std::string(const LayerStack&)> remark = [](const LayerStack&) { return ""; };  ///< on a judged network
};

/// What is to be trained, and how.
struct RobotReinforcementPlan {
  RobotTrainingOptions options;
  RobotNetworkOptions network;
  std::string init;           ///< model to start with; empty: a new network
  std::string checkpoint;     ///< empty: none
  std::string keep = "best";  ///< which network is written: best of the judgements, or last
  nlohmann::json settings;    ///< what the learning depends on
};

/// A model to start with has its own inputs and shape. Throws std::invalid_argument with a sentence for values that
/// make no sense.
void finishRobotNetwork(const CommandLine& line, RobotReinforcementPlan* plan, EncoderParameters* encoder);

/// settingsOf() without what older checkpoints do not name, where that is the default: they go on.
nlohmann::json changedSettingsOf(const RobotNetworkOptions& network, const EncoderParameters& encoder);

/// All options that ways of reinforcement have in common. `parameters` are the learner's: they hold the defaults and
/// take the values.
template <typename Parameters>
void addRobotReinforcementOptions(const std::vector<std::string>& arguments, RobotReinforcementPlan* plan,
                                  Parameters* parameters, CommandLine* line) {
  Parameters& p = *parameters;
  addRobotTrainingOptions(arguments, &plan->options, line);
  line->addFile("init", &plan->init, "model file to start from; it determines layers and inputs");
  line->addOutput("checkpoint", &plan->checkpoint, "checkpoint file: is written, and continued from if it exists");
  line->addChoice("keep", &plan->keep, {"best", "last"},
                  "which network to write: best (the most efficient of the networks judged so far) or last");
  visitPracticeParameters(p, line->everyParameter());
  addRobotNetworkOptions(&plan->network, &p.policy.encoder, line);
  line->whenParsed([=] { finishRobotNetwork(*line, plan, &parameters->policy.encoder); });
}

/// Hands what was parsed to the learner's parameters, and notes it in the plan's settings.
template <typename Parameters>
void finishRobotReinforcement(const std::string& method, RobotReinforcementPlan* plan, Parameters* parameters) {
  Parameters& p = *parameters;
  p.course = plan->options.course;
  p.max_steps = plan->options.max_steps;
  p.seed = plan->options.seed;
  p.threads = plan->options.threads;
  p.communicator = ranks();
  plan->settings = settingsOf(plan->options);
  plan->settings.update(changedSettingsOf(plan->network, p.policy.encoder));
  plan->settings.update({{"method", method}, {"init", plan->init}});
  visitPracticeParameters(p, noteIn(&plan->settings));
}

/// Those of the model to start with, whose description replaces `policy`, or new ones.
LayerStack firstLayers(const RobotReinforcementPlan& plan, PolicyDescription* policy);

/// Learns iteration by iteration, with a line for each; see DriveReinforcement and runTraining(). Returns the exit
/// status.
int trainByReinforcement(const RobotReinforcementPlan& plan, const PolicyDescription& policy, int iterations,
                         const RobotLearningTable& table, DriveLearner* learner);

}  // namespace lstm_planner
