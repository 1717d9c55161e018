#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/grid/cell_queue.hpp"
#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

/// What the path to the goal costs from the cells of an LocalMap: A* from the goal towards a start.
///
/// Searched from the goal, so that what was found stays of use when the robot has moved on: it tells of any place what
/// the path from there costs at least. Where obstacles have appeared since, paths have become costlier and the bounds
/// still hold; where some have gone, cheapestThrough() tells what a path through there costs at least.
///
/// Costs are in fifths of a cell (kStraightFifths, kDiagonalFifths), of steps into narrow and tight cells as many times
/// more. Bounded memory, two bytes a cell and the queue; from the first path on that costs more than two bytes tell,
/// 2.6 km of cells of 0.2 m with room, four bytes a cell more.
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

  /// Finds the cheapest path from elsewhere by the last search alone; false when that does not tell, because it did not
  /// come there or something has changed along the path.
  bool traceFrom(LocalMap& memory, int start, int column, int row);

  /// The cells of the path that was found last, from the start to the end.
  const std::vector<int>& path() const { return path_; }

  /// What the path from a cell costs at least; exactly that from all cells of a path that was just found.
  std::uint32_t cost(int cell) const;

  /// Lower bound of the cost of a path from `from` through the neighbourhood of `freed`, whose obstacle has disappeared
  /// since the search. Cells where the bound is `enough` anyway are not looked at closely.
  std::uint32_t cheapestThrough(LocalMap& memory, int freed, int reach, int from, std::uint32_t enough) const;

  /// Cost of a path of so many cells where nothing is in between.
  static std::uint32_t octile(int columns, int rows);
  std::uint32_t octileBetween(int from, int to) const;

  /// A cost as a length from cell to cell, m.
  static double metres(std::uint32_t cost, double cell_size) { return cost * cell_size / kStraightFifths; }

 private:
  static constexpr std::uint16_t kFar = 0xffff;
  /// The cells of a row from one column to another.
  struct Span {
    std::uint16_t first;
    std::uint16_t last;
  };
  static std::size_t index(int cell) { return static_cast<std::size_t>(cell); }
  bool searchOnce(LocalMap& memory, const std::vector<End>& ends);
  void clear(int side);
  template <typename Cost>
  void forgetTouched(Cost unknown, std::vector<Cost>* costs);
  /// What is left from a cell, less base_; kNone when it is not known.
  std::uint32_t left(int cell) const {
    const std::size_t i = index(cell);
    return is_wide_ ? wide_costs_[i] : costs_[i] == kFar ? kNone : costs_[i];
  }
  /// kNone comes out as kFar.
  void setLeft(std::size_t cell, std::uint32_t cost) {
    if (is_wide_) {
      wide_costs_[cell] = cost;
    } else {
      costs_[cell] = static_cast<std::uint16_t>(cost);
    }
  }
  void reach(int column, int row, std::uint32_t cost);
  bool run(LocalMap& memory, int target);
  void expand(LocalMap& memory, int column, int row, std::uint32_t cost);
  void forgetOpen();
  void trace(LocalMap& memory, int start, int column, int row);
  std::uint8_t entries(LocalMap& memory, int cell) const;
  int next(LocalMap& memory, int cell, int column, int row) const;
  bool isAtBorder(int cell) const;
  std::uint32_t relativeCost(int column, int row) const;
  std::uint32_t costBySteps(LocalMap& memory, int column, int row) const;
  int neighbourOf(int cell, int direction) const;
  std::uint32_t stepCost(LocalMap& memory, int to, int direction) const;

  int factors_[4];  ///< of the passages, in halves
  int side_ = 0;    ///< cells
  int start_ = 0;
  int start_column_ = 0;
  int start_row_ = 0;
  std::uint32_t base_ = 0;                 ///< of all costs_
  std::uint32_t searched_to_ = 0;          ///< the search has looked at all cells up to this estimate, less base_
  std::vector<std::uint16_t> costs_;       ///< of cells; kFar where not known
  std::vector<std::uint32_t> wide_costs_;  ///< instead, where is_wide_
  bool is_wide_ = false;
  bool overflowed_ = false;    ///< something cost too much for costs_
  std::vector<Span> touched_;  ///< columns of a row, by row
  CellQueue open_;
  std::vector<int> path_;
};

}  // namespace lstm_planner
