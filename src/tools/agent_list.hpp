#pragma once

#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_agent_factory.hpp"
#include "lstm_planner/grid_world/evaluation/grid_report.hpp"

namespace lstm_planner {

/// Agents from texts like `astar`, `lstm` (the shipped model) or `lstm=FILE,no-shield,no-escape`; all else as in
/// `common`. Names that would be alike are told apart by the model's file. Throws std::invalid_argument with a
/// sentence.
std::vector<ReportAgent> agentsFromTexts(const std::vector<std::string>& texts, const GridAgentOptions& common);

}  // namespace lstm_planner
