#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/scan_match.hpp"
#include "lstm_planner/drive/perception/scan_surfaces.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/drive/perception/slip_watch.hpp"

namespace lstm_planner {

/// Takes the drift of the odometry away: matches the scan, every 0.3 m, with scans that were taken near by and are
/// kept.
///
/// So the robot knows where it is with respect to where it started, and where it was before, to a fraction of what
/// odometry knows: remembered obstacles stay where they are, and so does the goal. Where a scan shows no surfaces, in
/// an open field, the odometry's motion is taken. Where they show that the robot has not moved at all, it has not
/// (SlipWatch). There is no map to begin with, and none comes out.
///
/// Poses that come out are in the corrected frame, which is the odometry frame at the start and after restart(). Its
/// memory is bounded. Not thread safe.
class DriftCorrection {
 public:
  /// 32 bytes a beam each: 7 MB with 1,081 beams.
  static constexpr std::size_t kMostKeyScans = 200;

  /// The pose of `situation`, which is that of the odometry, becomes the corrected one. Throws std::invalid_argument
  /// when it is out of reach (checkPose).
  void correct(Situation* situation);

  /// The odometry jumped: forgets all.
  void restart();

  /// The odometry frame in the corrected frame, after the last correct().
  const Pose2& correction() const { return correction_; }

  /// Whether the robot stands while the odometry goes on.
  SlipWatch& slip() { return slip_; }

 private:
  double turnRate(const Situation& situation) const;
  bool isDue(const Pose2& odometry, bool turns_fast) const;
  void match(const Pose2& odometry, bool turns_fast);
  void chooseKeys(const Pose2& pose);
  bool isNew(const Pose2& pose, double share) const;
  void keep(const Pose2& pose);

  Pose2 correction_;
  Pose2 previous_;              ///< odometry of the last situation
  double previous_time_ = 0.0;  ///< s
  Pose2 last_odometry_;         ///< when it was matched last
  double moved_ = 0.0;          ///< m, since the last match that was sure
  double turned_ = 0.0;         ///< rad
  SlipWatch slip_;
  std::vector<KeyScan> keys_;
  ScanSurfaces surfaces_;             ///< of the current scan
  std::vector<SurfacePiece> pieces_;  ///< of the current scan
  std::vector<const KeyScan*> near_;  ///< the nearest first
};

}  // namespace lstm_planner
