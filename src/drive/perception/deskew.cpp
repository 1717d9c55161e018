#include "lstm_planner/drive/perception/deskew.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lstm_planner/drive/perception/sectors.hpp"

namespace lstm_planner {
namespace {

constexpr double kLeastMotion = 0.005;  // m
constexpr std::size_t kPieces = 16;     // of a scan, in each of which the scanner moves evenly

/// Where the scanner was in the course of a scan, in its frame at the stamp.
class ScannerMotion {
 public:
  ScannerMotion(const LaserScan& scan, const SensorMount& mount, const BeamTimes& times,
                const std::function<Pose2(double)>& pose_at) {
    const Pose2 to_scanner = inverse(compose(pose_at(scan.stamp), mount.pose));
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const double share = static_cast<double>(i) / kPieces;
      const double time = scan.stamp + times.first + share * (times.last - times.first);
      poses_[i] = compose(to_scanner, compose(pose_at(time), mount.pose));
    }
  }

  bool isAtRest(double least_turn) const {
    return std::all_of(poses_.begin(), poses_.end(), [&](const Pose2& pose) {
      return std::hypot(pose.x, pose.y) < kLeastMotion && std::abs(pose.yaw) < least_turn;
    });
  }

  /// `share`: of the scan, in [0, 1].
  Pose2 at(double share) const {
    const auto piece = std::min(kPieces - 1, static_cast<std::size_t>(share * kPieces));
    const Pose2& from = poses_[piece];
    const Pose2& to = poses_[piece + 1];
    const double part = share * kPieces - static_cast<double>(piece);
    return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
            from.yaw + part * normalizeAngle(to.yaw - from.yaw)};
  }

 private:
  std::array<Pose2, kPieces + 1> poses_;
};

/// The ranges of a scan that is filled beam by beam.
class NewRanges {
 public:
  explicit NewRanges(const LaserScan& scan)
      : ranges_(scan.ranges.size(), kNotMeasured),
        is_return_(scan.ranges.size(), false),
        beams_a_turn_(std::lround(kFullTurn / std::abs(scan.angle_increment))) {}

  void put(long beam, float reading, bool is_return) {
    const long count = static_cast<long>(ranges_.size());
    if (beam < 0 || beam >= count) beam += beam < 0 ? beams_a_turn_ : -beams_a_turn_;
    if (beam < 0 || beam >= count) return;
    const auto at = static_cast<std::size_t>(beam);
    if (is_return_[at] && !(is_return && reading < ranges_[at])) return;
    ranges_[at] = reading;
    is_return_[at] = is_return;
  }

  const std::vector<float>& ranges() const { return ranges_; }

 private:
  std::vector<float> ranges_;
  std::vector<bool> is_return_;
  long beams_a_turn_;
};

/// A reading, and where it lies as seen from the stamp; the place as a number of beams from the first.
struct MovedReading {
  long beam = 0;
  float reading = 0.0f;
  bool is_return = false;
};

MovedReading moved(const LaserScan& scan, const RangeProfile& profile, double mirror, const ScannerMotion& motion,
                   std::size_t beam) {
  const double increment = mirror * scan.angle_increment;
  const Pose2 pose = motion.at(static_cast<double>(beam) / static_cast<double>(scan.ranges.size() - 1));
  const auto turned = static_cast<double>(beam) + pose.yaw / increment;
  if (!profile.isMeasured(beam)) return {std::lround(turned), scan.ranges[beam], false};

  const double direction = mirror * scan.angle_min + static_cast<double>(beam) * increment;
  const double range = scan.ranges[beam];
  const Point2 point = toParentFrame(pose, {range * std::cos(direction), range * std::sin(direction)});
  // The robot's way shifts what is near more than the turn does.
  const double shift = normalizeAngle(std::atan2(point.y, point.x) - direction - pose.yaw);
  const double nearest = std::max(scan.range_min, 1e-3);
  const double seen = std::clamp(std::hypot(point.x, point.y), nearest, std::max(nearest, scan.range_max));
  return {std::lround(turned + shift / increment), static_cast<float>(seen), true};
}

}  // namespace

void deskew(const SensorMount& mount, const ScanRules& rules, const std::function<Pose2(double)>& pose_at,
            LaserScan* scan) {
  const BeamTimes times = rules.beam_times.value_or(BeamTimes{});
  if ((times.first == 0.0 && times.last == 0.0) || scan->ranges.size() < 2 || !isScan(*scan, mount)) return;
  const ScannerMotion motion(*scan, mount, times, pose_at);
  if (motion.isAtRest(0.5 * std::abs(scan->angle_increment))) return;

  RangeProfile profile;
  toProfile(*scan, mount, rules, &profile);
  NewRanges ranges(*scan);
  MovedReading now = moved(*scan, profile, mount.mirror(), motion, 0);
  for (std::size_t beam = 0; beam < scan->ranges.size(); ++beam) {
    ranges.put(now.beam, now.reading, now.is_return);
    if (beam + 1 == scan->ranges.size()) break;
    const MovedReading next = moved(*scan, profile, mount.mirror(), motion, beam + 1);
    // Where the turn spreads the beams, none may be left out between two that are neighbours.
    if (next.beam == now.beam + 2) ranges.put(now.beam + 1, now.reading, now.is_return);
    now = next;
  }
  scan->ranges = ranges.ranges();
}

}  // namespace lstm_planner
