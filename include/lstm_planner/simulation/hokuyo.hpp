#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/scan_rules.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// A scanning range finder; the defaults are a Hokuyo UTM-30LX-EW with urg_node. Its maker states a repeatability of
/// 10 mm up to 10 m and of 30 mm up to 30 m (standard deviations). Units: visitHokuyoParameters().
struct HokuyoParameters {
  int beams = 1081;
  double angle_min = -2.35619;
  double angle_increment = 0.00436332;
  double range_min = 0.023;
  double range_max = 60.0;
  double sight = 30.0;
  double noise = 0.01;
  double range_step = 0.0;
  double dropout = 0.001;
  double rate = 40.0;
  BeamTimes beam_times;  ///< when the beams are measured: all at once
  SensorMount mount;     ///< in the base frame

  /// Whether the beams are measured one after the other.
  bool isSwept() const { return beam_times.first != beam_times.last; }
};

/// As the real one measures, whose beams are 17.36 us apart.
inline HokuyoParameters swept(HokuyoParameters scanner = {}) {
  scanner.beam_times = {0.0, 0.01875};
  return scanner;
}

/// The default scanner, turned to look back.
inline HokuyoParameters lookingBack() {
  HokuyoParameters scanner;
  scanner.mount.pose.yaw = 3.14159;
  return scanner;
}

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitHokuyoParameters(Parameters& laser, const Visitor& visit) {
  visit("beams", laser.beams, {1, 100000}, "", "of a scan");
  visit("angle_min", laser.angle_min, {-10.0, 10.0}, "rad", "of the first beam");
  visit("angle_increment", laser.angle_increment, {-10.0, 10.0}, "rad", "from beam to beam");
  visit("range_min", laser.range_min, {0.0, 100.0}, "m", "as the driver reports it");
  visit("range_max", laser.range_max, {0.0, 1000.0}, "m", "as the driver reports it");
  visit("sight", laser.sight, {0.01, 1000.0}, "m", "farthest obstacle that is really seen");
  visit("noise", laser.noise, {0.0, 10.0}, "m", "standard deviation of a range up to 10 m; three times that beyond");
  visit("range_step", laser.range_step, {0.0, 1.0}, "m", "ranges are rounded to multiples of it; 0: not rounded");
  visit("dropout", laser.dropout, {0.0, 1.0}, "", "probability that a beam returns nothing");
  visit("rate", laser.rate, {0.1, 200.0}, "Hz", "of scans");
  visit("first_beam", laser.beam_times.first, {-1.0, 1.0}, "s", "when the first beam is measured, after the stamp");
  visit("last_beam", laser.beam_times.last, {-1.0, 1.0}, "s", "when the last beam is measured, after the stamp");
  visit("x", laser.mount.pose.x, {-100.0, 100.0}, "m", "position of the scanner in the base frame");
  visit("y", laser.mount.pose.y, {-100.0, 100.0}, "m", "position of the scanner in the base frame");
  visit("yaw", laser.mount.pose.yaw, {-10.0, 10.0}, "rad", "direction of the scanner in the base frame");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const HokuyoParameters& parameters);

/// Takes scans of a world. As from the driver, a beam without a return is +inf, and a lost beam is NaN; a reading below
/// range_min is given as it is. The beams are measured one after the other, as `beam_times` says: motion distorts a
/// scan. The noise comes from a table of normal numbers, with one random draw for each beam. The same for the same
/// seed.
class Hokuyo {
 public:
  /// Throws as validate().
  Hokuyo(const HokuyoParameters& parameters, std::uint64_t seed);

  /// The scan from `base_pose` (pose of the robot in the world); `scan` is overwritten and its memory reused.
  void scan(const World& world, const Pose2& base_pose, double stamp, LaserScan* scan);
  /// The same of a robot that moves: `pose_at` says where it was at a time (s).
  void sweep(const World& world, const std::function<Pose2(double)>& pose_at, double stamp, LaserScan* scan);

  /// The stamp of a scan whose last measurement is at `time`, s.
  double stampOf(double time) const {
    return time - std::max({0.0, parameters_.beam_times.first, parameters_.beam_times.last});
  }

  /// What its readings mean: the rules of the driver.
  static ScanRules rules() { return urgNodeRules(); }

  const HokuyoParameters& parameters() const { return parameters_; }

 private:
  void castRays(const World& world, const std::function<Pose2(double)>& pose_at, double stamp);
  double rounded(double range) const;

  HokuyoParameters parameters_;
  Random random_;
  std::vector<float> noise_;  ///< m
  std::vector<double> ranges_;
  std::vector<double> piece_;  ///< of ranges_, measured from one pose
};

}  // namespace lstm_planner
