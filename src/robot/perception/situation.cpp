#include "lstm_planner/robot/perception/situation.hpp"

namespace lstm_planner {

void perceive(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, double range_cap,
              Situation* situation) {
  checkScan(scan, mount);
  toProfile(scan, mount, rules, &situation->profile);
  situation->sectors = averageSectors(situation->profile, rules.least_measured, range_cap);
  toPoints(situation->profile, &situation->beams, &situation->obstacles);
  situation->marked.clear();
}

}  // namespace lstm_planner
