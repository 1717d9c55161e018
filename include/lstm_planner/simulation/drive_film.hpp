#pragma once

#include <string>

#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/simulation/drive.hpp"

namespace lstm_planner {

/// How often a film is drawn, and how large.
struct FilmParameters {
  double period = 0.4;     ///< s from frame to frame, > 0
  int longest_side = 600;  ///< pixels, 16 or more
};

/// Draws a drive as the robot knows it, a frame in each period: what was never seen is grey, what was seen is white,
/// remembered obstacles are black, the scan is violet, the plan orange, the driven path has the colour of who decided
/// it (TracePicture), the goal is green.
///
/// `floor` gives the area of the picture; its cells are not drawn. Frames are PNG files in `folder`, which must exist:
/// 0000.png, 0001.png ... Throws std::invalid_argument for an empty floor. The listener throws std::runtime_error if a
/// frame cannot be written.
DriveListener filmOf(const OccupancyGrid& floor, const DriveTask& task, const std::string& folder,
                     const FilmParameters& parameters);

}  // namespace lstm_planner
