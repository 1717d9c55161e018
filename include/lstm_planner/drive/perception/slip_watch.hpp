#pragma once

#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/scan_surfaces.hpp"

namespace lstm_planner {

/// Notices that the odometry goes on while the scans stay the same: the wheels slip, the base has died and a filter
/// goes on at its last speed, or the scanner repeats a scan. Where scans cannot tell, as in a corridor whose ends are
/// out of sight, it says nothing.
///
/// Each scan is compared with the one before: the surfaces that would have moved if the robot had show whether it has.
/// Three in a row must show that it has not: one alone may be late, behind a fast turn.
class SlipWatch {
 public:
  /// The next scan, about 0.3 m or 0.3 rad after the one before, and the pose by odometry. Whether it shows that the
  /// robot is where it was.
  bool note(const std::vector<SurfacePiece>& pieces, const ScanSurfaces& surfaces, const Pose2& odometry);

  /// How far the robot has moved by odometry and not by the scans, m, with 1 m for a radian of a turn; 0 as long as
  /// that is not sure. It stays until the robot has driven for a bit, and until clear().
  double slipped() const { return times_ < kSure ? 0.0 : slipped_; }

  /// What the odometry said in vain: the pose of the robot, in the odometry frame, is this times what the odometry
  /// says. The identity as long as that is not sure. Only right after note() said true, and once.
  Pose2 takeBack();

  /// Begins to count anew.
  void clear();

 private:
  static constexpr int kSure = 3;

  bool has_scan_ = false;
  ScanSurfaces surfaces_;  ///< of the last scan
  Pose2 odometry_;         ///< of the last scan
  Pose2 stood_;            ///< by odometry, when the robot moved along with it last
  int times_ = 0;          ///< in a row
  double slipped_ = 0.0;   ///< m and rad
};

}  // namespace lstm_planner
