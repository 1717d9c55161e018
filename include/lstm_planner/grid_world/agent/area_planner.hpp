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

/// What cells that were never seen cost, and when the whole area is searched.
struct AreaPlannerParameters {
  CornerCutting corner_cutting = CornerCutting::kForbidden;
  /// A block that was never seen costs 1 + far_weight * d times its length, at most 1 + most_far_weight times: d is how
  /// much longer the octile distance from the start over the block to the goal is than that from start to goal,
  /// relative to it.
  double far_weight = 0.5;
  double most_far_weight = 8.0;
  double doubtful_cost = 20.0;  ///< cells, for a passage through a gap that is probably closed
  /// Cells by which the path among the near cells may be longer than the octile distance, before blocks are searched.
  double most_detour = 15.0;
};

/// The remembered path to the goal: searches in a whole area, with a bounded memory. At first it is A* among the cells
/// near the agent, to the goal or to the edge of the window of cells. As soon as that path is long, it is D* with a
/// memory of blocks (BlockGraph) instead of cells: a path is planned twice, from block to block in the whole window of
/// 640 x 640 cells, then from cell to cell along the first of these blocks.
///
/// Like D* it takes what it has not seen for free. Unlike D* it doubts small gaps between walls, and what was never
/// seen costs more if it is far from start and goal: so a goal near the start is searched for near the start.
class AreaPlanner {
 public:
  explicit AreaPlanner(const AreaPlannerParameters& parameters = {});

  /// Forgets everything. `start`: where the whole path begins, and where the agent is.
  void restart(CellIndex start);

  /// Sees and remembers. To be called once before every step, also if something else decides the step.
  void observe(const GridObservation& observation);
  bool sawSomethingNew() const { return !seen_.changedBlocks().empty(); }

  /// After observe(): the direction of the path, or kNoPath when there is none in what is remembered. The agent may go
  /// elsewhere.
  int plan();

  /// After plan(): cells by which the path becomes longer if the agent makes that possible move; 0 if the path is as
  /// short, infinity if no path is found from its end.
  double regretOf(int direction);

  /// From now on it plans from block to block, as it does when the path is long.
  void searchBlocks();
  bool searchesBlocks() const { return searches_blocks_; }

  /// Approximate length of the path to the goal by the latest plan, cells.
  double length() const { return length_; }

  std::size_t expandedCells() const { return search_.expandedNodes(); }
  std::size_t bytes() const;

 private:
  struct BlockWorld;
  struct CellWorld;
  struct NearWorld;

  /// A path from cell to cell.
  struct Plan {
    CellIndex from;
    int cost = 0;  ///< to its end; among the near cells also the octile distance from there to the goal
    std::size_t step = 0;
    std::vector<std::uint8_t> moves;  ///< the first ones

    bool empty() const { return step >= moves.size(); }
    void clear() { moves.clear(); }
    void goOn();
  };

  void followAgent();
  bool isPathFree() const;
  bool isBlocked(CellIndex cell) const;
  bool isLong() const;
  void planAnew();
  BlockWorld blockWorld(bool through_closed) const;
  bool keepBlocks();
  bool planBlocks(bool through_closed);
  void planCells();
  bool planCellsTo(CellIndex block, bool through_doubtful, std::size_t along);
  bool findCells(CellIndex from, Plan* plan);
  CellWorld cellWorld(CellIndex from) const;
  template <typename World>
  bool find(const World& world, CellIndex from, Plan* plan);

  AreaPlannerParameters parameters_;
  SeenGrid seen_;
  BlockGraph graph_;
  BoundedSearch search_;
  GridObservation now_;
  CellIndex start_;
  bool searches_blocks_ = false;
  int steps_since_plan_ = 0;
  int steps_since_blocks_ = 0;  ///< since the blocks were searched
  double length_ = 0.0;
  std::array<BlockGraph::Passage, kGridRayCount> from_agent_{};
  Plan plan_;   ///< from where the agent is
  Plan other_;  ///< from where another move leads
  // Where among the blocks the paths of cells lead.
  CellIndex target_;
  bool through_doubtful_ = true;  ///< cells
  std::size_t along_ = 0;         ///< the path stays in so many of the blocks; 0: it may go anywhere
  CellIndex blocks_from_;
  std::vector<std::uint8_t> blocks_;  ///< moves from there to the next block, the first of the whole path
};

}  // namespace lstm_planner
