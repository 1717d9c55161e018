#include "lstm_planner/agent/situation.hpp"

namespace lstm_planner {

void perceive(const LaserScan& scan, const SensorMount& mount, const ScanLimits& limits, double range_cap,
              Situation* situation) {
  situation->sectors = averageSectors(scan, mount, limits, range_cap);
  toPoints(scan, mount, limits, &situation->obstacles);
  toProfile(scan, mount, limits, &situation->profile);
}

}  // namespace lstm_planner
