#include "lstm_planner/drive/perception/beam_times_watch.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/drive/perception/deskew.hpp"
#include "lstm_planner/drive/perception/sectors.hpp"

namespace lstm_planner {
namespace {

constexpr double kShortestTurn = 0.05;  // s: the motion within a shorter one is hardly seen
constexpr double kNotTurned = 0.03;     // rad in two turns of the scanner
constexpr double kLeastTurned = 0.16;   // likewise
constexpr double kLongestAgo = 3.0;     // s since the reference
constexpr double kFarthestAway = 1.0;   // m
constexpr double kWorstMisfit = 0.3;    // m: what is farther from every surface was not seen before
constexpr int kFewestScans = 8;         // of turns
constexpr double kClearlyBetter = 0.7;  // of the next best misfit

/// Mean distance of the returns, seen from `pose` in the frame of the surfaces, from these, m.
double misfit(const RangeProfile& profile, const Pose2& pose, const ScanSurfaces& surfaces) {
  double sum = 0.0;
  int returns = 0;
  for (std::size_t beam = 0; beam < profile.ranges.size(); ++beam) {
    if (!profile.isMeasured(beam)) continue;
    const Point2 point = toParentFrame(pose, pointAlong(profile.origin, profile.direction(beam), profile.ranges[beam]));
    const SurfacePiece* piece = surfaces.nearest(point, kWorstMisfit);
    sum += piece == nullptr
               ? kWorstMisfit
               : std::abs((point.x - piece->at.x) * piece->normal.x + (point.y - piece->at.y) * piece->normal.y);
    ++returns;
  }
  return returns > 0 ? sum / returns : kWorstMisfit;
}

}  // namespace

BeamTimesWatch::Times BeamTimesWatch::possibleTimes(double sweep) {
  return {{{0.0, 0.0}, {0.0, sweep}, {sweep, 0.0}, {-sweep, 0.0}, {0.0, -sweep}}};
}

void BeamTimesWatch::show(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, double turn,
                          const std::function<Pose2(double)>& pose_at) {
  if (found_ || turn < kShortestTurn || scan.stamp == newest_ || !isScan(scan, mount)) return;
  newest_ = scan.stamp;
  const double share = static_cast<double>(scan.ranges.size()) * std::abs(scan.angle_increment) / kFullTurn;
  const double sweep = turn * std::min(1.0, share);
  const double turned = std::abs(normalizeAngle(pose_at(scan.stamp + sweep).yaw - pose_at(scan.stamp - sweep).yaw));
  const bool is_reference = turned < kNotTurned;
  if (!is_reference && (turned < kLeastTurned || !reference_)) return;

  const Pose2 pose = pose_at(scan.stamp);
  Profiles profiles;
  const Times times = possibleTimes(sweep);
  for (std::size_t rule = 0; rule < kRules; ++rule) {
    ScanRules by_these = rules;
    by_these.beam_times = times[rule];
    LaserScan corrected = scan;
    deskew(mount, by_these, pose_at, &corrected);
    toProfile(corrected, mount, rules, &profiles[rule]);
  }
  if (is_reference) {
    setReference(scan.stamp, pose, profiles);
  } else if (std::abs(scan.stamp - reference_->time) < kLongestAgo &&
             distanceBetween(pose, reference_->pose) < kFarthestAway) {
    compare(pose, profiles, times);
  }
}

void BeamTimesWatch::setReference(double time, const Pose2& pose, const Profiles& profiles) {
  if (!reference_) reference_.emplace();
  reference_->time = time;
  reference_->pose = pose;
  for (std::size_t rule = 0; rule < kRules; ++rule) reference_->surfaces[rule].show(profiles[rule]);
}

void BeamTimesWatch::compare(const Pose2& pose, const Profiles& profiles, const Times& times) {
  const Pose2 moved = compose(inverse(reference_->pose), pose);
  for (std::size_t rule = 0; rule < kRules; ++rule) {
    misfits_[rule] += misfit(profiles[rule], moved, reference_->surfaces[rule]);
  }
  ++scans_;
  const auto best = std::min_element(misfits_.begin(), misfits_.end());
  const auto worse =
      std::count_if(misfits_.begin(), misfits_.end(), [&](double misfit) { return *best <= kClearlyBetter * misfit; });
  if (scans_ >= kFewestScans && worse == kRules - 1) found_ = times[static_cast<std::size_t>(best - misfits_.begin())];
}

}  // namespace lstm_planner
