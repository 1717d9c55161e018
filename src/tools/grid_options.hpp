#pragma once

#include <boost/program_options.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_agent_factory.hpp"
#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"

namespace lstm_planner {

/// What evaluate and report have in common: scenarios, rules, and how agents are set up.
struct GridOptions {
  std::vector<std::string> folders;
  ScenarioSelection selection;
  GridEvaluationOptions evaluation;
  GridAgentOptions agent;

  // As given, until checked.
  std::int64_t count = 0;
  std::string maps = "all";
  std::string heuristic = "octile";
};

void addGridOptions(GridOptions* options, boost::program_options::options_description* description);

/// Takes over what was parsed. Throws std::invalid_argument with a sentence for values that make no sense.
void finishGridOptions(const boost::program_options::variables_map& values, GridOptions* options);

/// All sets of the folders. Reads the scenarios and maps, so that bad ones are found before a long run.
std::vector<GridTaskSet> drawGridTaskSets(const GridOptions& options);

}  // namespace lstm_planner
