#pragma once

#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// The cells of a costmap as costmap_2d keeps them, in the costmap's frame. Somebody else owns them.
struct CostGrid {
  const unsigned char* costs = nullptr;  ///< row by row from the origin
  int columns = 0;
  int rows = 0;
  double resolution = 0.0;        ///< m, side of a cell
  Point2 origin;                  ///< m, corner of the first cell
  double inscribed_radius = 0.0;  ///< m; inflation marks cells as inscribed that are nearer to an obstacle
};

/// The obstacles of a costmap around the robot that a scan does not show: from a depth camera or sonar, cliffs,
/// keep-out zones. Those within `reach` (m) of the robot, as points of the base frame, 6 cm or a cell apart. `base`:
/// pose of the base frame in the costmap's, `returns` of the scan in the base frame.
///
/// Obstacles are lethal cells, and inscribed cells without a lethal cell that explains them. A cell that holds a
/// return, or is beside such a cell, is left out: the return is more exact. A cell that is surrounded by obstacles is
/// left out, too, unless it is near the robot: a robot that does not touch the rim does not touch the inside.
std::vector<Point2> costmapObstacles(const CostGrid& grid, const Pose2& base, const std::vector<Point2>& returns,
                                     double reach);

}  // namespace lstm_planner
