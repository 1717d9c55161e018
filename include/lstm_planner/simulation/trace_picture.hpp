#pragma once

#include <string>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/decision/decision.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// What is drawn over a map; everything in the map frame, m and rad.
struct TracePicture {
  /// A goal of a drive.
  struct Goal {
    Point2 position;
    std::string label;
    bool reached = true;
  };
  /// A part of a path, in the colour of who decided it.
  struct Part {
    Decision::Choice choice = Leader::kNetwork;
    bool on_path = true;  ///< along the remembered path
    std::vector<Point2> path;
  };
  std::vector<std::vector<Point2>> traces;  ///< red, as in the thesis's figures
  std::vector<Part>
      parts;  ///< over them: network red (detours orange), greedy violet, route blue, escape teal, others grey
  std::vector<std::vector<Point2>>
      walkers;                    ///< thin grey paths of people, pale but for the last 100 places; a disc at the end
  std::vector<Circle> circles;    ///< obstacles that are not in the map
  std::vector<Pose2> starts;      ///< dark blue arrows
  std::vector<Goal> goals;        ///< green discs with their label; missed ones are orange and crossed out
  std::vector<Point2> contacts;   ///< magenta crosses
  double robot_radius = 0.17425;  ///< m, drawn around starts and goals
  std::string title;              ///< below the map
  bool legend = false;            ///< says below the map what is what, with the scale
};

/// Adds a place to a path: to its last part, or to a new part if another one decides from there on.
void goOn(const Point2& place, Decision::Choice choice, bool on_path, std::vector<TracePicture::Part>* parts);

/// Draws the map (obstacles black, unknown grey) with `picture` and a scale bar, and writes it in the format of the
/// file's extension (png, jpg ...). The map's longer side has about `longest_side` pixels. Throws std::invalid_argument
/// for an empty map, and std::runtime_error naming the file if it cannot be written.
void writeTracePicture(const std::string& path, const OccupancyGrid& map, const TracePicture& picture,
                       int longest_side = 1600);

}  // namespace lstm_planner
