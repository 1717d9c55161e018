#pragma once

#include <vector>

#include "lstm_planner/base/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// Distance from each cell's centre to the nearest centre of a blocked cell, m (0 in blocked cells, a large finite
/// value where nothing is blocked). Blocked are occupied cells, unknown ones when `unknown_blocks`; the outside is not.
/// Throws std::invalid_argument for a grid of more than 46340 cells a side.
class DistanceField {
 public:
  DistanceField() = default;
  DistanceField(const OccupancyGrid& grid, bool unknown_blocks);
  float at(CellIndex index) const;  ///< 0 outside

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> distances_;
};

/// Length of the shortest 8-connected path (Dijkstra; no cutting of corners) from every cell to `goal` through cells
/// whose distance-field value is at least `clearance` (m): the distance-to-go of a robot of that radius; +inf where
/// there is none, and so everywhere when the goal itself lies in such a place. The cost of a cell can be raised near
/// obstacles: a cell nearer than `comfort` costs up to `1 + reluctance` times its length, so that the paths keep to the
/// middle of doors.
class GeodesicField {
 public:
  /// Where paths may lead, and what they cost near obstacles.
  struct Options {
    double clearance = 0.2;
    double comfort = 0.0;  ///< m; 0 = pure length
    double reluctance = 0.0;
  };
  GeodesicField(const OccupancyGrid& grid, const DistanceField& distances, CellIndex goal, const Options& options);
  float at(CellIndex index) const;  ///< m; +inf outside and where there is no path

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> lengths_;
};

}  // namespace lstm_planner
