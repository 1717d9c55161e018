#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/world/range_table.hpp"

namespace lstm_planner {

/// How an episode in a grid is run. It ends at the latest when the agent is within one cell of the goal, along rows and
/// columns (thesis 3.3).
struct GridEpisodeRules {
  CornerCutting corner_cutting = CornerCutting::kForbidden;
  std::int64_t max_steps = 1000;  ///< 0 = no limit but gridStepBound(), and the end of walks in circles
};

/// Steps after which an episode without limit ends, so that an agent that walks in circles stops: 16 for each cell of
/// the map, at least a million. Boundary following arrived after at most 0.95 for each cell.
std::int64_t gridStepBound(const PassableGrid& grid);

/// Steps without entering a new cell after which an episode without limit ends: an agent that repeats its state walks
/// among the same cells for ever. Agents that are certain to arrive need far fewer: on the grid benchmark at most 1000,
/// plus 0.4 for each cell entered before.
constexpr std::int64_t circlingSteps(std::int64_t cells_entered) { return 4000 + 4 * cells_entered; }

/// Result of one episode. Trivially copyable, so that a list of them can be sent from process to process.
struct GridEpisode {
  /// How the episode ended.
  enum class End : std::uint8_t {
    kArrived,    ///< within one cell of the goal
    kCollision,  ///< tried to move into something blocked, which ends the episode
    kTimeout,    ///< after the largest number of steps, or after a walk in circles
    kNoPath,     ///< the agent said that the goal cannot be reached
  };
  End end = End::kTimeout;
  std::int64_t straight_moves = 0;
  std::int64_t diagonal_moves = 0;
  double optimal_length = 0.0;  ///< cells, of the scenario
  double seconds = 0.0;         ///< processor time of the agent and its sensing, from start() to the last step
  /// Cells that a search took from its open list; for an agent that does not search, its steps (thesis, Table 3.6).
  std::int64_t expanded = 0;
  std::int64_t peak_bytes = 0;
  std::array<std::int64_t, kGridLeaderCount> led{};  ///< steps, by GridLeader
  std::int64_t on_path = 0;                          ///< steps that the network decided, on the remembered path
  std::int64_t overruled_by_shield = 0;              ///< steps with another move than the network preferred
  std::int64_t overruled_by_bound = 0;

  std::int64_t steps() const { return straight_moves + diagonal_moves; }
  double length() const { return lengthOfMoves(straight_moves, diagonal_moves); }  ///< cells travelled

  /// Length / optimum. The agent stops within one cell of the goal, so this can be a little below 1; it is 1 if the
  /// start is that near already.
  double ratio() const;
};

/// Runs `agent` from `start` to `goal` in a map; `ranges` must be those of that map. Writes the visited cells to
/// `path`, if it is given. Throws std::invalid_argument for a start that is blocked or outside, and std::logic_error
/// for a decision that is not a direction.
GridEpisode runGridEpisode(const PassableGrid& grid, const RangeTable& ranges, CellIndex start, CellIndex goal,
                           const GridEpisodeRules& rules, GridAgent* agent, std::vector<CellIndex>* path = nullptr);

}  // namespace lstm_planner
