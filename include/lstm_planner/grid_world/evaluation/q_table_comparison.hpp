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
  int starts = 50;                                           ///< to judge from, of each map; never too near to the goal
  std::vector<int> episodes = {10, 100, 1000, 3000, 10000};  ///< after which is judged, rising
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
  double arrived = 0.0;    ///< share
  double ratio = 0.0;      ///< length / optimum, mean of those that arrived; not a number where none did
};
/// The rows of one kind of maps.
struct QTableOutcome {
  std::string maps;
  std::vector<QTableRow> rows;
};

/// Judges a table after so many episodes from random starts, the last one also for another goal than it learned, and
/// `others`, which have seen none of the maps: tabular Q-learning (thesis Eq. 2.35) beside networks. `progress` is told
/// the share done.
std::vector<QTableOutcome> compareQTables(const QTableComparisonParameters& parameters,
                                          const std::vector<std::pair<std::string, GridAgentMaker>>& others,
                                          const std::function<void(double)>& progress = {});

/// A Markdown table.
std::string toMarkdown(const std::vector<QTableOutcome>& outcomes);

}  // namespace lstm_planner
