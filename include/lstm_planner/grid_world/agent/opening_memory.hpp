#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/agent/visit_trace.hpp"

namespace lstm_planner {

/// The places that an agent has seen and not visited, and how far it would have to walk back to them.
///
/// Nothing is searched: back to an opening the agent walks by the path that it came by, and how long that is follows
/// from the distances to the start (StartDistance) of the two places, as long as it goes back by the path that it came.
///
/// Distances are octile, in cells. 4 KiB: of more openings those are forgotten that lead to the goal by the longest
/// path, and none is remembered beyond column or row 32,767.
class OpeningMemory {
 public:
  struct Opening {
    std::int16_t column = 0;
    std::int16_t row = 0;
    float branch = 0.0f;  ///< distance to the start of the place where the path to it leaves the path back to the start
    float beyond = 0.0f;  ///< from that place to the opening
  };

  OpeningMemory();

  void clear();

  /// Once before each step; `trace` has seen it, and `start_distance` is that of the agent.
  void observe(const GridObservation& observation, const VisitTrace& trace, float start_distance);

  /// By how much the path to the goal through the opening that a ray shows is longer than the straight one at least;
  /// empty for a ray that shows none.
  const std::array<std::optional<float>, kGridRayCount>& detours() const { return detours_; }

  /// Of the openings that are not near, the one with the shortest path through it to the goal; empty: none.
  const std::optional<Opening>& bestBehind() const { return best_behind_; }
  float walkTo(const Opening& opening) const { return here_ - opening.branch + opening.beyond; }

  static std::size_t bytes();

 private:
  void forgetVisited(CellIndex cell);
  void note(CellIndex place, float length, CellIndex goal);
  void chooseBest(CellIndex goal);

  std::vector<Opening> openings_;
  std::array<std::optional<float>, kGridRayCount> detours_{};
  std::optional<Opening> best_behind_;
  float here_ = 0.0f;  ///< the agent's distance to the start
};

}  // namespace lstm_planner
