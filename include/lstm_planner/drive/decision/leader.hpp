#pragma once

#include <string>

namespace lstm_planner {

/// Who leads a drive: decides its steps, many in a row.
enum class Leader {
  kNetwork,  ///< the allowed action that the network prefers
  kGreedy,   ///< the allowed action nearest to the goal's bearing
  kRoute,    ///< the path through what is remembered
  kEscape    ///< boundary following (BugAlgorithm); no parameter names it
};

/// "network", "greedy", "route", "escape".
const char* toString(Leader leader);

/// The leaders' names among the parameters: "network", "route", and "none" for kGreedy.
std::string nameOfLeader(Leader leader);
/// Throws std::invalid_argument with the names there are.
Leader leaderNamed(const std::string& name);

}  // namespace lstm_planner
