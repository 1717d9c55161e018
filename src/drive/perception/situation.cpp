#include "lstm_planner/drive/perception/situation.hpp"

#include <string>

namespace lstm_planner {

void perceive(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, double range_cap,
              Situation* situation) {
  checkScan(scan, mount);
  toProfile(scan, mount, rules, &situation->profile);
  situation->sectors = averageSectors(situation->profile, rules.least_measured, range_cap);
  situation->obstacles.clear();
  addPoints(situation->profile, &situation->beams, &situation->obstacles);
  situation->marked.clear();
  situation->second.profile.ranges.clear();
}

void perceiveSecond(const TakenScan& taken, const ScanRules& rules, Situation* situation) {
  SecondView& view = situation->second;
  // As if it had been mounted there when the first scan was taken.
  const Pose2 moved = compose(inverse(situation->pose), taken.pose);
  const SensorMount mount{compose(moved, taken.mount.pose), taken.mount.upside_down};
  try {
    checkScan(taken.scan, mount);
    toProfile(taken.scan, mount, rules, &view.profile);
    checkMeasured(view.profile, rules.least_measured);
  } catch (const UnusableScan& error) {
    throw UnusableScan("the second scanner: " + std::string(error.what()));
  }
  view.time = taken.time;
  addPoints(view.profile, &view.beams, &situation->obstacles);
}

}  // namespace lstm_planner
