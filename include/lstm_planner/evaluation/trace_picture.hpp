#pragma once

#include <string>
#include <vector>

#include "lstm_planner/geometry.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// What is drawn over a map; everything in the map frame, m and rad.
struct TracePicture {
  struct Goal {
    Point2 position;
    std::string label;
    bool reached = true;
  };
  std::vector<std::vector<Point2>> traces;  ///< red, as in the thesis's figures
  std::vector<Pose2> starts;                ///< blue arrows
  std::vector<Goal> goals;                  ///< green discs with their label; missed ones are orange and crossed out
  std::vector<Point2> contacts;             ///< magenta crosses
  double robot_radius = 0.17425;            ///< m, drawn around starts and goals
};

/// Draws the map (obstacles black, unknown grey) with what is given and a scale bar, and writes it in the format that
/// the file's extension names (png, jpg ...). The longer side has about `longest_side` pixels. Throws
/// std::invalid_argument for an empty map, std::runtime_error naming the file when it cannot be written.
void writeTracePicture(const std::string& path, const OccupancyGrid& map, const TracePicture& picture,
                       int longest_side = 1600);

}  // namespace lstm_planner
