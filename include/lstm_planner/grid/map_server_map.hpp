#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// A map that cannot be read; what() names the file, the field, its value and what was expected.
class MapFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a map in the format of map_server (image, resolution, origin, negate, occupied_thresh, free_thresh, mode). The
/// mean of a pixel's channels counts: with mode trinary, which is the default, alpha is one of them; with mode scale it
/// is not, and values between the thresholds are unknown here. A non-negative `free_threshold` replaces the
/// free_thresh of the file: use 0.19 for maps of Willow Garage, where the grey value 206 of unknown cells is free with
/// the 0.196 in the file. The image is a PNM, PNG, BMP or JPEG file with 8 or 16 bits and at most 2^26 pixels. Throws
/// MapFileError, also when no cell is free by map_server's rule.
OccupancyGrid readMapServerMap(const std::string& yaml_path, double free_threshold = -1.0);

/// Path and threshold of FILE or FILE=FREE_THRESHOLD, as for `--map`; the threshold is -1 if there is none. Throws
/// MapFileError for one outside [0, 1].
std::pair<std::string, double> splitFreeThreshold(const std::string& text);

/// Reads a map named FILE or FILE=FREE_THRESHOLD. Unknown cells become occupied: otherwise the shortest path, or a
/// robot, would leave the building through the gaps of its map. Throws as readMapServerMap().
OccupancyGrid readClosedMap(const std::string& text);

/// Writes `<stem>.yaml` and `<stem>.pgm`; reading them gives the same grid. Throws MapFileError.
void writeMapServerMap(const std::string& stem, const OccupancyGrid& grid);

}  // namespace lstm_planner
