#pragma once

#include <string>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// Paths of several agents between the same cells (thesis, Figures 3.9-3.14).
struct GridPicture {
  /// What one agent walked.
  struct Path {
    std::string label;
    std::vector<CellIndex> cells;
    bool arrived = true;  ///< a path that ended elsewhere ends with a cross
  };
  std::string title;
  CellIndex start;
  CellIndex goal;
  std::vector<Path> paths;  ///< the first is drawn lowest and widest
};

/// Draws the part of the map that the paths touch, row 0 at the top, with the labels below it. Throws
/// std::invalid_argument for an empty map and std::runtime_error when the file cannot be written.
void writeGridPicture(const std::string& path, const PassableGrid& grid, const GridPicture& picture);

}  // namespace lstm_planner
