#pragma once

#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_agent_factory.hpp"
#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"
#include "tools/command_line.hpp"

namespace lstm_planner {

inline const Choices<MapSelection> kMapSelections = {
    {"train", MapSelection::kTrain}, {"validation", MapSelection::kValidation}, {"all", MapSelection::kAll}};

/// What evaluate and report have in common: scenarios, rules, and how agents are set up.
struct GridOptions {
  std::vector<std::string> folders;
  ScenarioSelection selection;
  GridEvaluationOptions evaluation;
  GridAgentOptions agent;

  double straight_cost = 1.0;
  double diagonal_cost = moveLength(1);
};

/// `options` must stay where they are until the line is parsed.
void addGridOptions(GridOptions* options, CommandLine* line);

/// All sets of the folders. Reads the scenarios and maps, so that bad ones are found before a long run.
std::vector<GridTaskSet> drawGridTaskSets(const GridOptions& options);

/// The tasks of one set, with the optimal lengths by the rules of the episodes.
GridTaskSet drawTasksOfSet(const GridSetFiles& files, const ScenarioSelection& selection,
                           const GridEvaluationOptions& evaluation);

}  // namespace lstm_planner
