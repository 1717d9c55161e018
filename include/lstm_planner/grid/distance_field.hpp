#pragma once

#include <limits>

#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// Distance from the centre of each cell to the nearest centre of a blocked cell, m. It is 0 in blocked cells, and a
/// large finite value if no cell is blocked. Occupied cells are blocked; unknown ones are if `unknown_blocks`; cells
/// outside the grid are not. Throws std::invalid_argument for a grid with more than 46340 cells on a side.
class DistanceField {
 public:
  DistanceField() = default;
  DistanceField(const OccupancyGrid& grid, bool unknown_blocks);
  float at(CellIndex index) const { return distances_.at(index, 0.0f); }  ///< 0 outside

 private:
  CellField<float> distances_;
};

/// Length of the shortest 8-connected path from every cell to `goal`, in the unit of `resolution`: +inf where there is
/// no path, or one of 2^24 cells or more. `cost` is what a length in a cell counts: at least 1, or 0 where no path may
/// lead. A move costs the mean of its two cells. If the goal is outside or its cost is 0, no cell has a path to it. For
/// costs of float and std::uint8_t.
template <typename Cost>
CellField<float> pathLengths(const CellField<Cost>& cost, CellIndex goal, CornerCutting corner_cutting,
                             double resolution);

/// Length of the shortest 8-connected path from every cell to `goal` (pathLengths(), no corner cutting), m. The path
/// keeps to cells whose distance to a blocked cell is at least `clearance` (m), the radius of the robot. The length is
/// +inf if there is no path; it is +inf everywhere if the goal is outside or too near to a blocked cell. Cells nearer
/// than `comfort` to a blocked cell may count up to `1 + reluctance` times their length, so that paths lead through the
/// middle of doors.
class GeodesicField {
 public:
  /// Where paths may lead, and what they cost near obstacles.
  struct Options {
    double clearance = 0.2;  ///< m
    double comfort = 0.0;    ///< m; 0: costs are lengths
    double reluctance = 0.0;
  };
  GeodesicField(const OccupancyGrid& grid, const DistanceField& distances, CellIndex goal, const Options& options);
  /// m; +inf outside and where there is no path.
  float at(CellIndex index) const { return lengths_.at(index, std::numeric_limits<float>::infinity()); }
  /// The neighbour with the shortest path; at the goal the cell itself.
  CellIndex nextOnPath(CellIndex cell) const;

 private:
  CellField<float> lengths_;
};

}  // namespace lstm_planner
