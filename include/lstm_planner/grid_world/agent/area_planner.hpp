#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid_world/agent/block_graph.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/agent/seen_grid.hpp"
#include "lstm_planner/grid_world/search/bounded_search.hpp"

namespace lstm_planner {

/// What the planner holds against cells that were never seen.
struct AreaPlannerParameters {
  CornerCutting corner_cutting = CornerCutting::kForbidden;
  /// How much more a cell costs that was never seen, for each time that the path from the start over it to the goal is
  /// longer, as the crow flies, than the straight one.
  double far_weight = 0.5;
  double most_far_weight = 8.0;
  double doubtful_cost = 20.0;  ///< cells, for a passage through a gap that is probably none
};

/// Searches for the goal in a whole area, with a bounded memory: D* with a memory of blocks (BlockGraph) instead of
/// cells. Paths are planned twice: from block to block in the whole window of 640 cells, then along the first of these
/// blocks from cell to cell.
///
/// Like D* it takes what it has not seen for free. Unlike D* it doubts small gaps between walls, and what was never
/// seen costs the more, the farther away it lies from start and goal: a goal near the start is searched for near it.
class AreaPlanner {
 public:
  explicit AreaPlanner(const AreaPlannerParameters& parameters = {});

  /// Forgets everything. `start`: where the whole path began.
  void restart(CellIndex agent, CellIndex start);

  /// Takes over what another has seen.
  void takeWalls(const RollingGrid& walls);

  /// Once before every step, whoever makes it: sees and remembers.
  void observe(const GridObservation& observation);
  bool sawSomethingNew() const { return !seen_.changedBlocks().empty(); }

  /// After observe(): the direction to move in, or kNoPath when there is none in what is remembered.
  int plan();

  /// How long the path to the goal is about, as the latest plan has it, cells.
  double length() const { return length_; }

  std::size_t expandedCells() const { return search_.expandedNodes(); }
  std::size_t bytes() const;

 private:
  using Search = BoundedSearch<3072, 255>;
  struct BlockWorld;
  struct CellWorld;

  bool isPathFree() const;
  bool isBlocked(CellIndex cell) const;
  void planAnew();
  BlockWorld blockWorld(bool through_closed) const;
  bool keepBlocks();
  bool planBlocks(bool through_closed);
  void planCells();
  bool planCellsTo(CellIndex block, bool through_doubtful, std::size_t along);

  AreaPlannerParameters parameters_;
  SeenGrid seen_;
  BlockGraph graph_;
  Search search_;
  GridObservation now_;
  CellIndex start_;
  CellIndex expected_;  ///< where the agent is when it follows the path
  int steps_since_plan_ = 0;
  int steps_since_blocks_ = 0;  ///< were searched
  double length_ = 0.0;
  bool path_is_doubtful_ = false;  ///< it goes through doubtful cells
  std::array<BlockGraph::Passage, kGridRayCount> from_agent_{};
  std::size_t path_step_ = 0;
  std::vector<std::uint8_t> path_;  ///< directions from where the plan started
  CellIndex blocks_from_;
  std::vector<std::uint8_t> blocks_;  ///< moves from there to the next block, the first of the whole path
};

}  // namespace lstm_planner
