#pragma once

#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/sectors.hpp"

namespace lstm_planner {

/// A scan, and where and when it was taken.
struct TakenScan {
  const LaserScan& scan;
  const SensorMount& mount;  ///< of the scanner in the base frame
  const Pose2 pose;          ///< base in the odometry frame
  const double time;         ///< s
};

/// What a second scanner sees, in the base frame of the situation.
struct SecondView {
  RangeProfile profile;
  double time = 0.0;  ///< s, when it was taken
  BeamDirections beams;
};

/// What the agent knows at one moment: its pose according to odometry, and what the scanner sees from there.
struct Situation {
  double time = 0.0;              ///< s
  Pose2 pose;                     ///< base in the odometry frame
  Sectors sectors;                ///< for the network
  std::vector<Point2> obstacles;  ///< measured returns in the base frame, m, of both scanners where there are two; for
                                  ///< shield, escape and controller
  std::vector<Point2> marked;     ///< obstacles of a costmap (costmapObstacles()), base frame, m; perceive() has none
  RangeProfile profile;           ///< the same scan by direction, in the base frame; for what is seen to be free
  BeamDirections beams;           ///< of the scanner; only perceive() needs them, and only to be fast
  SecondView second;              ///< without ranges where the robot has one scanner
};

/// Fills sectors, obstacles and profile from a scan, reusing the memory of `situation`. Planner, controller, recorder
/// and simulation check and interpret scans only here. Throws UnusableScan as averageSectors(); `situation` must then
/// not be used. What a second scanner saw before is forgotten.
void perceive(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, double range_cap,
              Situation* situation);

/// Adds what a second scanner sees to a situation whose pose is known: returns, and what is seen to be free. It may
/// look anywhere, and the sectors do not change. The robot may have moved between the two scans. Throws UnusableScan as
/// checkScan() and checkMeasured(), with the words "the second scanner" in front; `situation` must then not be used.
void perceiveSecond(const TakenScan& taken, const ScanRules& rules, Situation* situation);

}  // namespace lstm_planner
