#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <iosfwd>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_episode.hpp"
#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"

namespace lstm_planner {

/// Makes an agent for a map; called from several threads at once.
using GridAgentMaker = std::function<std::unique_ptr<GridAgent>(const PassableGrid&)>;

/// How episodes are run.
struct GridEvaluationOptions {
  GridEpisodeRules rules;
  int threads = 2;
  std::function<void(double)> progress;  ///< told the share done, from the calling thread; may be empty
};

/// Runs the tasks [first, last) of a set, each with an agent of its own, and returns their episodes in this order.
/// Except for the times, they depend neither on the number of threads nor on how the tasks are split into ranges.
/// Throws std::invalid_argument for a range that the set does not have.
std::vector<GridEpisode> evaluateGridTasks(const GridTaskSet& set, std::size_t first, std::size_t last,
                                           const GridAgentMaker& make_agent, const GridEvaluationOptions& options);

/// One agent in one set. Means are over the episodes that arrived (not a number where none did), except for the time
/// of a step.
struct GridSetSummary {
  std::string name;
  std::size_t scenarios = 0;
  std::size_t arrived = 0;
  std::size_t collisions = 0;
  std::size_t timeouts = 0;
  std::size_t no_path = 0;
  double mean_ratio = 0.0;  ///< GridEpisode::ratio()
  double median_ratio = 0.0;
  double p95_ratio = 0.0;     ///< the smallest ratio that 95 % do not exceed
  double mean_length = 0.0;   ///< cells
  double mean_optimal = 0.0;  ///< cells
  double mean_time = 0.0;     ///< s
  double mean_expanded = 0.0;
  double ns_per_step = 0.0;     ///< over all episodes
  std::int64_t peak_bytes = 0;  ///< the highest of all episodes
  // Shares of the steps of all episodes.
  std::array<double, kGridLeaderCount> led{};  ///< by GridLeader: who decided
  double on_path = 0.0;                        ///< the network decided, on the remembered path
  double overruled_by_shield = 0.0;            ///< another move than the network preferred
  double overruled_by_bound = 0.0;

  double share(std::size_t count) const { return static_cast<double>(count) / static_cast<double>(scenarios); }
};

/// Throws std::invalid_argument when there is no episode.
GridSetSummary summarizeGridEpisodes(const std::string& name, const std::vector<GridEpisode>& episodes);

/// `success`, `collisions` and `timeouts` are shares of the scenarios; in the rest the agent said that there is no
/// path. A mean over nothing is null.
nlohmann::json toJson(const GridSetSummary& summary);

/// For people: one line a set.
void printGridSummaries(std::ostream& out, const std::vector<GridSetSummary>& summaries);

}  // namespace lstm_planner
