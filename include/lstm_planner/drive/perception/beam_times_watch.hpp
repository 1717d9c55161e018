#pragma once

#include <array>
#include <functional>
#include <optional>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/scan_rules.hpp"
#include "lstm_planner/drive/perception/scan_surfaces.hpp"

namespace lstm_planner {

/// Finds out when the beams of a scanner are measured. Drivers list the beams in the order of their measurement or
/// backwards, and stamp the first or the last one; simulators measure all at once. Scans that were taken in a turn are
/// corrected by each of these rules (deskew()) and compared with a scan that was taken a little before, when the robot
/// did not turn: the rule by which they fit clearly best is the driver's.
class BeamTimesWatch {
 public:
  /// Shows a scan as the driver sent it. `turn`: s that the scanner takes for a full turn. `pose_at`: where the base
  /// was at a time (s), in a frame that rests.
  void show(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, double turn,
            const std::function<Pose2(double)>& pose_at);

  /// None until they are found. Of a scanner with more than 20 turns a second they are not looked for.
  const std::optional<BeamTimes>& found() const { return found_; }

 private:
  static constexpr std::size_t kRules = 5;

  using Times = std::array<BeamTimes, kRules>;        ///< by each rule
  using Profiles = std::array<RangeProfile, kRules>;  ///< of a scan, corrected by each rule

  /// A scan that was taken when the robot did not turn.
  struct Reference {
    double time = 0.0;  ///< s
    Pose2 pose;
    std::array<ScanSurfaces, kRules> surfaces;
  };
  /// `sweep`: s from the first beam to the last one.
  static Times possibleTimes(double sweep);
  void setReference(double time, const Pose2& pose, const Profiles& profiles);
  void compare(const Pose2& pose, const Profiles& profiles, const Times& times);

  std::optional<Reference> reference_;
  double newest_ = 0.0;                   ///< s, stamp of the last scan
  std::array<double, kRules> misfits_{};  ///< m, sums over the scans of turns
  int scans_ = 0;                         ///< of turns
  std::optional<BeamTimes> found_;
};

}  // namespace lstm_planner
