#include "tools/train_grid_judge.hpp"

#include <iomanip>
#include <memory>
#include <sstream>
#include <utility>

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "tools/ranks.hpp"

namespace lstm_planner {

GridJudge::GridJudge(const GridTrainingOptions& options, std::vector<GridTaskSet> sets)
    : options_(options), sets_(std::move(sets)) {}

GridScore GridJudge::judge(const LayerStack& layers) const {
  Model model;
  model.layers = layers;
  writeGridMetadata(&model.metadata);
  NetworkGridAgent::Options shield_alone;
  shield_alone.guided = false;
  shield_alone.corner_cutting = options_.corner_cutting;
  const auto make_agent = [&](const PassableGrid&) { return std::make_unique<NetworkGridAgent>(model, shield_alone); };
  GridEvaluationOptions evaluation;
  evaluation.rules.max_steps = options_.max_steps;
  evaluation.rules.corner_cutting = options_.corner_cutting;
  evaluation.threads = options_.threads;
  evaluation.communicator = ranks();
  GridScore score;
  for (const GridTaskSet& set : sets_) {
    const auto summary =
        summarizeGridEpisodes(set.name, evaluateGridTasks(set, 0, set.tasks.size(), make_agent, evaluation));
    score.success.push_back(summary.share(summary.arrived));
    score.mean += score.success.back() / static_cast<double>(sets_.size());
  }
  return score;
}

void GridJudge::write(const LayerStack& layers, const GridScore& score) const {
  Model model;
  model.layers = layers;
  writeGridMetadata(&model.metadata);
  model.metadata["training_command"] = options_.command;
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "arrival on validation maps with the shield alone, paths of "
       << std::setprecision(0) << options_.min_length << " to " << options_.max_length << " cells in "
       << options_.max_steps << " steps:" << std::setprecision(3);
  for (std::size_t i = 0; i < sets_.size(); ++i) text << ' ' << sets_[i].name << ' ' << score.success[i];
  model.metadata["score"] = text.str();
  writeModelFile(options_.loop.output, model);
}

std::vector<std::string> GridJudge::names() const {
  std::vector<std::string> names;
  for (const GridTaskSet& set : sets_) names.push_back(set.name);
  return names;
}

}  // namespace lstm_planner
