#include "lstm_planner/agent/situation.hpp"

namespace lstm_planner {

void perceive(const LaserScan& scan, const SensorMount& mount, const ScanLimits& limits, double range_cap,
              Situation* situation) {
  checkScan(scan, mount);
  toProfile(scan, mount, limits, &situation->profile);
  situation->sectors = averageSectors(situation->profile, range_cap);
  toPoints(situation->profile, &situation->beams, &situation->obstacles);
}

}  // namespace lstm_planner
