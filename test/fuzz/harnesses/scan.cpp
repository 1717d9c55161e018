#include <cmath>
#include <vector>

#include "fuzz/fuzz_scan.hpp"
#include "fuzz/harness.hpp"
#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/perception/drift_correction.hpp"
#include "lstm_planner/drive/perception/moving_returns.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner::fuzz::scan_harness {
namespace {

constexpr double kRangeCap = 6.0;       // m
constexpr double kFootprint = 0.17425;  // m
constexpr double kPeriod = 0.1;         // s
constexpr std::size_t kMostScans = 4;

/// Told from the message alone, without the code that is tested: some beam ahead has a range or sees nothing.
bool isSomethingMeasuredAhead(const LaserScan& scan, const SensorMount& mount) {
  constexpr double kAhead = M_PI_2 + 0.5;  // rad; a beam's width and rounding more than the window
  const double sense = mount.upside_down ? -1.0 : 1.0;
  for (std::size_t beam = 0; beam < scan.ranges.size(); ++beam) {
    const double range = scan.ranges[beam];
    const double angle = mount.pose.yaw + sense * (scan.angle_min + static_cast<double>(beam) * scan.angle_increment);
    const bool is_range = range > 0.0 && range >= static_cast<float>(scan.range_min) && std::isfinite(range);
    const bool is_nothing = std::isinf(range) && range > 0.0;
    if ((is_range || is_nothing) && std::abs(normalizeAngle(angle)) <= kAhead) return true;
  }
  return false;
}

/// Likewise: some beam ahead has met something that the robot would touch within its margin.
bool isSomethingAtTheBumper(const LaserScan& scan, const SensorMount& mount, double margin) {
  constexpr double kStraightAhead = 0.3;  // rad
  const double sense = mount.upside_down ? -1.0 : 1.0;
  for (std::size_t beam = 0; beam < scan.ranges.size(); ++beam) {
    const double range = scan.ranges[beam];
    const double angle = mount.pose.yaw + sense * (scan.angle_min + static_cast<double>(beam) * scan.angle_increment);
    const bool is_range = range >= scan.range_min && range <= scan.range_max;
    const bool is_near = range > kFootprint && range < kFootprint + 0.9 * margin;
    if (is_range && is_near && std::abs(normalizeAngle(angle)) <= kStraightAhead) return true;
  }
  return false;
}

void checkSituation(const Situation& situation, const LaserScan& scan) {
  for (int sector = 0; sector < kSectorCount; ++sector) {
    const auto i = static_cast<std::size_t>(sector);
    require(situation.sectors.range[i] > 0.0 && situation.sectors.range[i] <= kRangeCap * (1.0 + 1e-6),
            "sector ranges are positive and at most the cap");
    require(situation.sectors.beams[i] > 0 && situation.sectors.measured[i] <= situation.sectors.beams[i],
            "each sector has beams");
  }
  require(situation.obstacles.size() <= scan.ranges.size(), "an obstacle is a beam");
  for (const Point2& point : situation.obstacles) {
    require(std::isfinite(point.x) && std::isfinite(point.y), "obstacles are finite");
  }
}

/// Some scans, one after the other, each seen by the planner's eyes and driven after by the controller.
void seeAndDrive(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  static const MotionParameters parameters;
  static const MotionController controller(parameters);
  static const std::vector<Pose2> straight_on = {{}, {0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
  Shield shield(Footprint(kFootprint), parameters.safety_margin, 2.0);
  MovingReturns moving(parameters.moving);
  DriftCorrection drift;
  Situation situation;
  double time = 0.0;
  for (std::size_t i = 0; i < kMostScans && !input.empty(); ++i) {
    const LaserScan scan = anyScan(&input);
    const SensorMount mount = anyMount(&input);
    const Twist2 twist{input.numberIn(-0.5, 0.5), input.numberIn(-3.0, 3.0)};
    time += input.number();
    try {
      perceive(scan, mount, {}, kRangeCap, &situation);
    } catch (const UnusableScan&) {
      continue;
    }
    require(isSomethingMeasuredAhead(scan, mount), "what was not measured is not free: the scan is refused");
    checkSituation(situation, scan);
    shield.show(situation.obstacles);
    moving.show(situation.profile, {}, time);
    situation.pose = {input.numberIn(-2.0, 2.0), input.numberIn(-2.0, 2.0), input.numberIn(-M_PI, M_PI)};
    drift.correct(&situation);
    require(isFinite(situation.pose), "a corrected pose is finite");
    const Twist2 command = controller.compute({straight_on, {}, twist, shield, kPeriod}, moving.points());
    require(command.linear >= 0.0 && command.linear <= parameters.max_linear, "the speed is within its limits");
    const bool is_in_the_middle = mount.pose.x == 0.0 && mount.pose.y == 0.0;
    require(
        !is_in_the_middle || !isSomethingAtTheBumper(scan, mount, parameters.safety_margin) || command.linear == 0.0,
        "the robot does not drive into what is at its bumper");
    require(std::abs(command.angular) <= parameters.max_angular, "the rate is within its limits");
  }
}

const Registration registration("scan", &seeAndDrive);

}  // namespace
}  // namespace lstm_planner::fuzz::scan_harness
