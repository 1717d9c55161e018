#include "lstm_planner/drive/perception/sectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "drive/perception/beam_sum.hpp"
#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {
namespace {

constexpr double kWindow = M_PI;
constexpr double kSectorWidth = kWindow / kSectorCount;

/// Part of an increment by which a beam may lie before a border and still count as on it. Drivers send angles as floats
/// or with six digits; over a thousand beams this adds up to some thousandths of an increment.
constexpr double kBorderTolerance = 0.02;

/// rad that may be missing at an edge of the window: no scanner of 180 degrees is mounted quite straight.
constexpr double kMissing = 3.0 * M_PI / 180.0;

/// The beams in counter-clockwise order in the base frame.
struct BeamFan {
  double start = 0.0;      ///< rad from the right edge of the window (-90 degrees) to the first beam, in (-2 pi, slack]
  double increment = 0.0;  ///< rad, positive
  long count = 0;          ///< beams of one turn at most
  double slack = 0.0;      ///< rad that may be missing at each edge of the window
  bool reversed = false;   ///< the order of the ranges is clockwise
};

std::string degrees(double radians) { return numberText(radians * 180.0 / M_PI) + " degrees"; }

/// The slack is half an increment, or `least_slack` (rad) where that is more.
BeamFan fanOf(const RangeProfile& profile, double least_slack = 0.0) {
  const long beams = static_cast<long>(profile.ranges.size());
  BeamFan fan;
  fan.reversed = profile.increment < 0.0;
  fan.increment = std::abs(profile.increment);
  double first = profile.first_direction;
  if (fan.reversed) first -= static_cast<double>(beams - 1) * fan.increment;
  // Beams of a second turn look where others have looked already; counting them would weigh these directions twice.
  const double beams_a_turn = std::ceil(kFullTurn / fan.increment - kBorderTolerance);
  fan.count = static_cast<long>(std::min(static_cast<double>(beams), beams_a_turn));
  fan.slack = std::max(least_slack, (0.5 + kBorderTolerance) * fan.increment);
  const double from_edge = first + kWindow / 2.0;
  fan.start = from_edge - kFullTurn * std::ceil((from_edge - fan.slack) / kFullTurn);
  return fan;
}

/// Index of the first beam at or after `angle` (rad from the window's right edge), clipped to the fan.
long firstBeamFrom(double angle, const BeamFan& fan) {
  const double index = std::ceil((angle - fan.start) / fan.increment - kBorderTolerance);
  return static_cast<long>(std::clamp(index, 0.0, static_cast<double>(fan.count)));
}

/// The window is half-open: its last beam lies one increment before the left edge.
bool coversWindow(const BeamFan& fan) {
  const double end = fan.start + static_cast<double>(fan.count) * fan.increment;
  return end >= kWindow - fan.slack;
}

using SectorCounts = std::array<int, kSectorCount>;

void addBeams(const std::vector<float>& ranges, double range_cap, const BeamFan& fan, double window_start,
              Sectors* sectors, SectorCounts* known) {
  const long beams = static_cast<long>(ranges.size());
  long begin = firstBeamFrom(window_start, fan);
  for (int sector = 0; sector < kSectorCount; ++sector) {
    const long end = std::max(begin, firstBeamFrom(window_start + (sector + 1) * kSectorWidth, fan));
    const BeamSum sum = sumOfBeams(ranges.data() + (fan.reversed ? beams - end : begin),
                                   static_cast<std::size_t>(end - begin), range_cap);
    sectors->range[sector] += sum.range;
    sectors->nearest[sector] = std::min<double>(sectors->nearest[sector], sum.nearest);
    sectors->measured[sector] += sum.measured;
    (*known)[sector] += sum.known;
    sectors->beams[sector] += static_cast<int>(end - begin);
    begin = end;
  }
}

[[noreturn]] void refuse(const std::string& what_it_has, const std::string& expected) {
  throw UnusableScan("the scan has " + what_it_has + ", expected " + expected);
}

/// Why beams of the scan may not have been measured.
std::string reasonsOf(const RangeProfile& profile) {
  const std::vector<float>& ranges = profile.ranges;
  const auto too_near = std::count(ranges.begin(), ranges.end(), -std::numeric_limits<float>::infinity());
  const auto not_measured = std::count(ranges.begin(), ranges.end(), 0.0f);
  std::string reasons;
  if (too_near > 0) {
    reasons = ": " + std::to_string(too_near) +
              " readings of the scan are -inf, which means that something is nearer " + "than range_min (REP-117)";
  }
  if (2 * profile.too_near > not_measured) {
    reasons += ": " + std::to_string(profile.too_near) +
               " readings of the scan are below range_min = " + numberText(profile.nearest_range) +
               " m: something is too near to be measured, and range_min must be less than about the footprint's " +
               "inscribed radius + clearance";
  } else if (not_measured > 0) {
    reasons += ": the scanner is covered, or its driver sends other readings for no return (no_return)";
  }
  return reasons;
}

/// A sector begins at `from` (rad around the robot's heading).
void checkSector(double from, double width, int beams, int known, double least_measured, const RangeProfile& profile) {
  if (beams == 0) {
    refuse("an increment of " + degrees(std::abs(profile.increment)),
           "at least one beam in each sector of " + degrees(width));
  }
  if (known == 0 || known < least_measured * beams) {
    refuse(std::to_string(known) + " of " + std::to_string(beams) + " beams measured from " + degrees(from) + " to " +
               degrees(from + width) + " around the robot's heading",
           "at least the share least_measured = " + numberText(least_measured) + reasonsOf(profile));
  }
}

}  // namespace

void checkScan(const LaserScan& scan, const SensorMount& mount) {
  constexpr std::size_t kMostBeams = 100000;
  constexpr double kFarthestFirstBeam = 4.0 * M_PI;
  constexpr double kFinestIncrement = 1e-5;
  constexpr double kFarthestMount = 100.0;                                                   // m
  const auto is_within = [](double value, double most) { return std::abs(value) <= most; };  // false for NaN
  if (scan.ranges.empty()) throw UnusableScan("the scan has no ranges, expected at least one beam a sector");
  if (scan.ranges.size() > kMostBeams) {
    refuse(std::to_string(scan.ranges.size()) + " ranges", "at most " + std::to_string(kMostBeams));
  }
  if (!is_within(scan.angle_min, kFarthestFirstBeam) || !is_within(scan.angle_increment, kFullTurn) ||
      is_within(scan.angle_increment, kFinestIncrement)) {
    refuse("angle_min " + numberText(scan.angle_min) + " and angle_increment " + numberText(scan.angle_increment),
           "finite angles and an increment other than 0 of at least 1e-5 rad");
  }
  if (!(scan.range_min >= 0.0 && scan.range_min < scan.range_max)) {
    refuse("range_min " + numberText(scan.range_min) + " and range_max " + numberText(scan.range_max),
           "0 or more, and range_min below range_max");
  }
  if (!isFinite(mount.pose)) throw UnusableScan("the pose of the scanner on the robot is not finite");
  if (!is_within(mount.pose.yaw, kFarthestFirstBeam)) {
    throw UnusableScan("the scanner is turned by " + numberText(mount.pose.yaw) +
                       " rad on the robot, expected at most two turns");
  }
  if (!is_within(mount.pose.x, kFarthestMount) || !is_within(mount.pose.y, kFarthestMount)) {
    throw UnusableScan("the scanner is at (" + numberText(mount.pose.x) + ", " + numberText(mount.pose.y) +
                       ") m on the robot, expected at most 100 m from its centre");
  }
}

Sectors averageSectors(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, double range_cap) {
  checkScan(scan, mount);
  RangeProfile profile;
  toProfile(scan, mount, rules, &profile);
  return averageSectors(profile, rules.least_measured, range_cap);
}

Sectors averageSectors(const RangeProfile& profile, double least_measured, double range_cap) {
  if (!(range_cap > 0.0) || !std::isfinite(range_cap)) {
    throw std::invalid_argument("the range cap is " + numberText(range_cap) +
                                " m, expected a positive finite distance");
  }
  BeamFan fan = fanOf(profile);
  // Only then: a full turn that starts in the window would miss the beams that it has at its end.
  if (!coversWindow(fan) && !profile.closes()) fan = fanOf(profile, kMissing);
  if (!coversWindow(fan) && !profile.closes()) {
    const double from = normalizeAngle(fan.start - kWindow / 2.0);
    const double span = static_cast<double>(fan.count - 1) * fan.increment;
    throw UnusableScan("the scan covers " + degrees(from) + " to " + degrees(from + span) +
                       " around the robot's heading, expected at least -87 to +87 degrees");
  }

  Sectors sectors;
  SectorCounts known{};
  addBeams(profile.ranges, range_cap, fan, 0.0, &sectors, &known);
  // A full turn may start inside the window: the rest of the window is then at the start of the fan.
  if (!coversWindow(fan)) addBeams(profile.ranges, range_cap, fan, -kFullTurn, &sectors, &known);

  for (int sector = 0; sector < kSectorCount; ++sector) {
    const double from = sector * kSectorWidth - kWindow / 2.0;
    checkSector(from, kSectorWidth, sectors.beams[sector], known[sector], least_measured, profile);
    sectors.range[sector] /= known[sector];
  }
  return sectors;
}

void checkMeasured(const RangeProfile& profile, double least_measured) {
  const BeamFan fan = fanOf(profile);
  const double span = static_cast<double>(fan.count) * fan.increment;
  const long sections = std::max(1L, std::lround(span / kSectorWidth));
  const double width = span / static_cast<double>(sections);
  const long beams = static_cast<long>(profile.ranges.size());
  for (long section = 0; section < sections; ++section) {
    const long begin = fan.count * section / sections;
    const long end = fan.count * (section + 1) / sections;
    const float* const first = profile.ranges.data() + (fan.reversed ? beams - end : begin);
    const int known = end > begin ? sumOfBeams(first, static_cast<std::size_t>(end - begin), 1.0).known : 0;
    const double from = normalizeAngle(fan.start - kWindow / 2.0 + static_cast<double>(section) * width);
    checkSector(from, width, static_cast<int>(end - begin), known, least_measured, profile);
  }
}

bool isScan(const LaserScan& scan, const SensorMount& mount) {
  try {
    checkScan(scan, mount);
    return true;
  } catch (const UnusableScan&) {
    return false;
  }
}

}  // namespace lstm_planner
