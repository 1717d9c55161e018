#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/grid/cell_queue.hpp"
#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

/// What the path to the goal costs from the cells of a LocalMap: A* from the goal towards a start.
///
/// Searched from the goal, so that one search tells of other places near the start, too, what the path from there
/// costs: it goes on until it has come to them.
///
/// Costs are in fifths of a cell (kStraightFifths, kDiagonalFifths), of steps into narrow and tight cells as many times
/// more. Bounded memory, four bytes a cell and the queue.
class CostToGo {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;  ///< there is no path

  /// A cell where paths may end, and what is left from there.
  struct End {
    int cell;
    std::uint32_t cost;
  };

  /// `tightness`: see RouteFinder.
  explicit CostToGo(double tightness);

  /// Finds the cheapest path from `start` to any of the ends; false when there is none. Of paths that are as good it
  /// takes the one that keeps nearest to that column and row, which may lie outside the window.
  bool search(LocalMap& memory, int start, const std::vector<End>& ends, int column, int row);

  /// The same from another cell to the ends of the last search. The memory must not have changed since.
  bool searchOn(LocalMap& memory, int start, int column, int row);

  /// The cells of the path that was found last, from the start to the end.
  const std::vector<int>& path() const { return path_; }

  /// What the path from a cell of path() costs.
  std::uint32_t cost(int cell) const { return costs_[index(cell)]; }

  /// Cost of a path of so many cells where nothing is in between.
  static std::uint32_t octile(int columns, int rows);

  /// How many times its length a path through a narrow place costs.
  static double narrowness(double tightness) { return 1.0 + 0.25 * (tightness - 1.0); }

  /// A cost as a length from cell to cell, m.
  static double metres(std::uint32_t cost, double cell_size) { return cost * cell_size / kStraightFifths; }

 private:
  /// The cells of a row from one column to another.
  struct Span {
    int first;
    int last;
  };
  static std::size_t index(int cell) { return static_cast<std::size_t>(cell); }
  void clear(int side);
  void reach(int column, int row, std::uint32_t cost);
  bool runTo(LocalMap& memory, int target);
  bool isSettled(int cell, std::uint32_t lowest) const;
  std::uint32_t estimate(int column, int row, std::uint32_t cost) const;
  void expand(LocalMap& memory, int column, int row, std::uint32_t cost);
  void trace(LocalMap& memory, int start, int column, int row);
  std::uint8_t entries(LocalMap& memory, int cell) const;
  int next(LocalMap& memory, int cell, int column, int row) const;
  int neighbourOf(int cell, int direction) const;
  std::uint32_t stepCost(LocalMap& memory, int to, int direction) const;

  int factors_[4];  ///< of the passages, in halves
  int side_ = 0;    ///< cells
  int start_column_ = 0;
  int start_row_ = 0;
  std::vector<std::uint32_t> costs_;  ///< of cells; kNone where the search has not been
  std::vector<Span> touched_;         ///< columns of a row, by row
  CellQueue open_;
  std::vector<int> path_;
};

}  // namespace lstm_planner
