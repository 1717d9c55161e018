#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_agent_factory.hpp"
#include "lstm_planner/grid_world/evaluation/grid_report.hpp"

namespace lstm_planner {

// What the reports about the grid world have in common. Texts about the pictures are appended to `report`, in Markdown.

/// Runs every agent in every set, with a bar.
void evaluateAll(const GridEvaluationOptions& options, GridComparison* comparison);

/// Figures 3.9-3.17 or their like: a CSV file and a picture of the trend for each set; of `training`, tasks in training
/// maps, the typical one of those that the first network solves, where there are any; and choosePictures().
void writeFigures(const GridComparison& comparison, const std::optional<GridTaskSet>& training,
                  const GridEvaluationOptions& options, const std::string& folder, std::ostream& report);

/// Agents from texts like `astar`, `lstm` (the shipped model) or `lstm=FILE,no-shield,no-escape`; all else as in
/// `common`. Names that would be alike are told apart by the model's file. Throws std::invalid_argument with a
/// sentence.
std::vector<ReportAgent> agentsFromTexts(const std::vector<std::string>& texts, const GridAgentOptions& common);

}  // namespace lstm_planner
