#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "lstm_planner/evaluation/grid_agent_factory.hpp"
#include "lstm_planner/evaluation/grid_evaluation.hpp"
#include "tools/command.hpp"
#include "tools/grid_options.hpp"
#include "tools/options.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"
#include "tools/shared_file.hpp"

namespace lstm_planner {

namespace {

struct EvaluateOptions {
  GridOptions grid;
  std::string json;
  std::string pictures;
};

std::string agentNames() {
  std::string names;
  for (const std::string& name : gridAgentNames()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

bool readOptions(const std::vector<std::string>& arguments, EvaluateOptions* options) {
  namespace po = boost::program_options;
  GridAgentOptions& agent = options->grid.agent;
  agent.model = "models/grid_lstm.onnx";
  po::options_description description("judges an agent in scenarios of grid maps");
  // clang-format off
  description.add_options()
      ("agent", po::value(&agent.agent)->default_value(agent.agent), agentNames().c_str())
      ("model", po::value(&agent.model)->default_value(agent.model), "ONNX file of an agent that is a network");
  addGridOptions(&options->grid, &description);
  description.add_options()
      ("json", po::value(&options->json), "write the result to this file; success, collisions and timeouts are shares "
       "of the scenarios, means are over the scenarios with success")
      ("pictures", po::value(&options->pictures), "draw some misses and the longest detour of each set into this "
       "folder");
  // clang-format on
  po::variables_map values;
  if (!parseOptions("evaluate", description, arguments, &values)) return false;
  finishGridOptions(values, &options->grid);
  if (isNetworkAgent(agent.agent)) {
    agent.model = findSharedFile(agent.model);
  } else if (values["model"].defaulted()) {
    agent.model.clear();
  } else {
    throw std::invalid_argument("agent " + agent.agent + " has no --model");
  }
  return true;
}

/// Progress over all sets as if they were one.
class SetProgress {
 public:
  explicit SetProgress(const std::vector<GridTaskSet>& sets) {
    for (const GridTaskSet& set : sets) tasks_ += set.tasks.size();
  }
  std::function<void(double)> ofSet(const GridTaskSet& set) {
    const auto before = static_cast<double>(done_);
    const auto tasks = static_cast<double>(set.tasks.size());
    done_ += set.tasks.size();
    return [=](double share) { bar_.show((before + share * tasks) / static_cast<double>(tasks_)); };
  }

 private:
  Progress bar_;
  std::size_t tasks_ = 0;
  std::size_t done_ = 0;
};

void writeJson(const EvaluateOptions& options, const std::vector<GridSetSummary>& summaries) {
  nlohmann::ordered_json json = {{"agent", options.grid.agent.agent}, {"model", options.grid.agent.model}};
  json["sets"] = nlohmann::ordered_json::array();
  for (const GridSetSummary& summary : summaries) json["sets"].push_back(toJson(summary));
  writeTextFile(options.json, json.dump(2) + "\n");
}

}  // namespace

int runEvaluate(const std::vector<std::string>& arguments) {
  EvaluateOptions options;
  if (!readOptions(arguments, &options)) return 0;
  if (!options.json.empty()) checkWritable(options.json);
  if (!options.pictures.empty()) makeOutputFolder(options.pictures);
  const GridAgentMaker make_agent = gridAgentMaker(options.grid.agent);
  const std::vector<GridTaskSet> sets = drawGridTaskSets(options.grid);

  SetProgress progress(sets);
  std::vector<GridSetSummary> summaries;
  for (const GridTaskSet& set : sets) {
    GridEvaluationOptions evaluation = options.grid.evaluation;
    evaluation.progress = progress.ofSet(set);
    const std::vector<GridEpisode> episodes = evaluateGridTasks(set, 0, set.tasks.size(), make_agent, evaluation);
    summaries.push_back(summarizeGridEpisodes(set.name, episodes));
  }
  printGridSummaries(std::cout, summaries);
  if (!options.json.empty()) writeJson(options, summaries);
  return 0;
}

}  // namespace lstm_planner
