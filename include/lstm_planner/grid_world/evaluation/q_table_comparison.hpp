#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/learning/q_table.hpp"

namespace lstm_planner {

/// How the table learns, and on what it is judged.
struct QTableComparisonParameters {
  QTableParameters table;
  int size = 32;                                             ///< cells, of the maps
  int maps = 5;                                              ///< of each kind
  int starts = 50;                                           ///< of the episodes that judge, in each map
  std::vector<int> episodes = {10, 100, 1000, 3000, 10000};  ///< after so many the table is judged; rising
  int max_steps = 1000;                                      ///< of an episode that judges
  std::uint64_t seed = 1;
  int threads = 2;  ///< does not change the result
};
/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const QTableComparisonParameters& parameters);

/// One row of the comparison: an agent in one kind of maps.
struct QTableRow {
  std::string agent;
  std::int64_t steps = 0;  ///< learned from on each map, on average; 0 for an agent that knows none of them
  double arrived = 0.0;    ///< share; not a number if all starts are too near to the goal
  double ratio = 0.0;      ///< length / optimum, mean of those that arrived; not a number if none did
};
/// The rows of one kind of maps.
struct QTableOutcome {
  std::string maps;
  std::vector<QTableRow> rows;
};

/// Compares tabular Q-learning (thesis Eq. 2.35) with `others`, which have seen none of the maps. The table learns in
/// episodes from random starts, and is judged after each number of `episodes`; after the last one also with another
/// goal. Calls `progress` with the share that is done. Throws as validate(), and std::runtime_error if a map has no two
/// cells far enough from each other.
std::vector<QTableOutcome> compareQTables(const QTableComparisonParameters& parameters,
                                          const std::vector<std::pair<std::string, GridAgentMaker>>& others,
                                          const std::function<void(double)>& progress = {});

/// A Markdown table.
std::string toMarkdown(const std::vector<QTableOutcome>& outcomes);

}  // namespace lstm_planner
