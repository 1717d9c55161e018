#pragma once

#include <memory>
#include <string>

#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/simulation/drive.hpp"

namespace lstm_planner {

/// Draws a drive as the robot knows it, frame by frame: what was never seen is grey, what was seen is white, remembered
/// obstacles are black, the scan is violet, the plan orange, the driven path has the colour of who decided it
/// (TracePicture), the goal is green.
class DriveFilm {
 public:
  /// How often is drawn, and how large.
  struct Parameters {
    double period = 0.4;     ///< s from frame to frame, > 0
    int longest_side = 600;  ///< pixels, 16 or more
  };

  /// `floor` says what is in the picture; its cells are not drawn. Frames are PNG files in `folder`, which must exist:
  /// 0000.png, 0001.png ... Throws std::invalid_argument for an empty floor.
  DriveFilm(const OccupancyGrid& floor, const DriveTask& task, const std::string& folder, const Parameters& parameters);
  ~DriveFilm();

  /// A DriveListener: draws a frame when it is time for one. Throws std::runtime_error when it cannot be written.
  void show(const DriveMoment& moment);

 private:
  class Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace lstm_planner
