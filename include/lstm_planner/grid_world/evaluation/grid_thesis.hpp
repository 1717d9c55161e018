#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

/// One of the thesis's tables of online tests, as printed: 50 scenarios with paths of at most 300 steps, corner cutting
/// allowed, 1,000 steps an episode.
struct ThesisTable {
  /// Values of one agent.
  struct Row {
    std::string agent;
    double success = 0.0;   ///< share
    double seconds = 0.0;   ///< average time, s
    double length = 0.0;    ///< average, cells
    double expanded = 0.0;  ///< average number of nodes
  };
  std::string number;
  std::string title;
  std::string trend_figure;  ///< success over the longest path allowed
  std::vector<Row> rows;
};

/// Whether a set's name says this kind, and ends in this number but for letters: "Mazes_2w" and "maze512-2" are "maze"
/// and "2".
bool isGridSet(const std::string& set_name, const std::string& kind, const std::string& number);

/// The table about a benchmark set, by the set's name ("DragonAge", "Mazes_8w", "Random25" or similar, see
/// isGridSet()); nullptr if the thesis has none.
const ThesisTable* thesisTableOf(const std::string& set_name);

}  // namespace lstm_planner
