#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"
#include "lstm_planner/grid_world/search/grid_path.hpp"
#include "lstm_planner/grid_world/search/heuristic.hpp"

namespace lstm_planner {

/// What becomes of a closed cell when a shorter path to it turns up. That happens with heuristics that are not
/// consistent only: Manhattan and scaled Euclidean.
enum class ClosedCells {
  kReopen,     ///< it is opened again, as in thesis Algorithm 1: shorter paths, for many more expansions
  kStayClosed  ///< no cell is expanded twice
};

struct AStarParameters {
  Heuristic heuristic = Heuristic::kOctile;
  CornerCutting corner_cutting = CornerCutting::kForbidden;
  ClosedCells closed_cells = ClosedCells::kReopen;
  MoveCosts costs = {};
  bool diagonal_moves = true;  ///< false: the thesis's first variant, four moves
};

struct AStarResult {
  GridPath path;               ///< a cheapest one if the heuristic never overestimates; empty when there is no path
  std::size_t expanded = 0;    ///< cells taken from the open list; a cell that was opened again counts again
  std::size_t peak_bytes = 0;  ///< of the search, without the grid
};

/// A* on a known grid (thesis Algorithm 1), offline.
class AStar {
 public:
  /// `grid` must stay where it is and must not change its size.
  explicit AStar(const PassableGrid& grid, AStarParameters parameters = {});

  /// Throws std::invalid_argument when start or goal is outside or not passable.
  AStarResult find(CellIndex start, CellIndex goal);

 private:
  struct Node {
    MoveCost cost = 0;           ///< of the best path known from the start
    std::uint32_t search = 0;    ///< the search that this node was last reached in
    std::uint8_t direction = 0;  ///< of the move that led here
    bool closed = false;
  };
  struct Open {
    MoveCost estimate;  ///< of the whole path
    MoveCost cost;
    CellIndex cell;
  };
  struct Later;

  void checkEnd(const char* name, CellIndex cell) const;
  void startSearch();
  void open(CellIndex cell, int direction, MoveCost cost, CellIndex goal);
  void expand(CellIndex cell, CellIndex goal);
  Node& node(CellIndex cell) { return nodes_[grid_->offset(cell)]; }
  GridPath trace(CellIndex start, CellIndex goal);

  const PassableGrid* grid_;
  AStarParameters parameters_;
  std::vector<Node> nodes_;
  std::vector<Open> open_;  ///< a heap; cells that were closed meanwhile stay in it until they are taken out
  std::size_t most_open_ = 0;
  std::uint32_t search_ = 0;
};

}  // namespace lstm_planner
