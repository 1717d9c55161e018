#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "lstm_planner/common/overruled.hpp"
#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// What an agent of the grid world knows before a step (thesis 3.2): where it is, where it is going, and how far the
/// eight rays reach.
struct GridObservation {
  CellIndex cell;
  CellIndex goal;
  GridRanges ranges{};
};

/// Answer of an agent that has found out that there is no path to the goal.
constexpr int kNoPath = -1;

/// What decided a step.
enum class GridLeader {
  kNetwork,
  kSearch,    ///< a path was searched for, in the whole map or in what is remembered
  kBoundary,  ///< following a boundary
  kGreedy,    ///< the neighbour nearest to the goal
};
constexpr int kGridLeaderCount = 4;

/// "network", "search", "boundary", "greedy".
inline const char* nameOf(GridLeader leader) {
  constexpr std::array<const char*, kGridLeaderCount> kNames = {"network", "search", "boundary", "greedy"};
  return kNames[static_cast<std::size_t>(leader)];
}

/// An agent that moves from cell to cell towards a goal: the one interface of learned, reactive and searching agents.
///
/// An episode is start(), then observe(), decide(), step() again and again, until the goal is reached.
class GridAgent {
 public:
  virtual ~GridAgent() = default;

  /// Forgets everything of the episode before.
  virtual void start(CellIndex start, CellIndex goal) = 0;

  virtual void observe(const GridObservation& observation) = 0;

  /// The direction to move in (index in kGridRaySteps), or kNoPath. The same for every call after one observation.
  virtual int decide() = 0;

  /// What decided the direction that decide() returns.
  virtual GridLeader leader() const = 0;

  /// Whether a network's choice was overruled in that decision; kNo for other leaders.
  virtual Overruled overruled() const { return Overruled::kNo; }
  /// Whether a network decided, and its move lies on a shortest path between the remembered walls.
  virtual bool onPath() const { return false; }

  /// Result of the move that was tried: `moved` is false if it ran into an obstacle.
  virtual void step(int /*direction*/, bool /*moved*/) {}

  /// The most memory that the agent itself has needed in the episode so far, bytes: the model's weights, hidden state,
  /// escape, lists and maps of a search.
  virtual std::size_t peakBytes() const = 0;

  /// Cells taken from the open list of a search since start(); 0 for an agent that does not search.
  virtual std::size_t expandedCells() const { return 0; }
};

}  // namespace lstm_planner
