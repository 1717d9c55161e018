#pragma once

#include <vector>

#include "lstm_planner/base/common/geometry.hpp"
#include "lstm_planner/robot/perception/laser_scan.hpp"
#include "lstm_planner/robot/perception/sectors.hpp"

namespace lstm_planner {

/// What the agent knows at one moment: its pose according to odometry, and what the scanner sees from there.
struct Situation {
  double time = 0.0;              ///< s
  Pose2 pose;                     ///< base in the odometry frame
  Sectors sectors;                ///< for the network
  std::vector<Point2> obstacles;  ///< measured returns in the base frame, m; for shield, escape and controller
  std::vector<Point2> marked;     ///< obstacles of a costmap (CostmapObstacles), base frame, m; perceive() has none
  RangeProfile profile;           ///< the same scan by direction, in the base frame; for what is seen to be free
  BeamDirections beams;           ///< of the scanner; only perceive() needs them, and only to be fast
};

/// Fills sectors, obstacles and profile from a scan, reusing the memory of `situation`. Planner, controller, recorder
/// and simulation check and interpret scans only here. Throws UnusableScan as averageSectors(); `situation` must then
/// not be used.
void perceive(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, double range_cap,
              Situation* situation);

}  // namespace lstm_planner
