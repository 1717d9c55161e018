#pragma once

#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/scan_surfaces.hpp"

namespace lstm_planner {

/// A scan that is kept, and the pose it was taken from (base frame, in the frame of the match).
struct KeyScan {
  Pose2 pose;
  ScanSurfaces surfaces;
};

/// How wrong the predicted pose may be: standard deviations.
struct PoseError {
  double position = 0.0;  ///< m, in x and in y
  double yaw = 0.0;       ///< rad
};

/// Where a scan was taken from.
struct ScanMatch {
  Pose2 pose;
  double share = 0.0;    ///< of the pieces that lie on a surface of a key scan
  bool is_sure = false;  ///< enough of them do, and the pose is not much farther off than expected
};

/// Finds the pose from which `pieces` (base frame) lie on the surfaces of key scans: the most likely one, given the
/// predicted pose and its error, by Gauss-Newton steps on the distances between pieces and lines (Chen and Medioni
/// 1992, Censi 2008). In a corridor, whose walls say nothing of how far along it the robot is, the prediction does.
/// Things that have moved are outliers, which count little.
ScanMatch matchScan(const std::vector<SurfacePiece>& pieces, const std::vector<const KeyScan*>& keys,
                    const Pose2& predicted, const PoseError& error);

}  // namespace lstm_planner
