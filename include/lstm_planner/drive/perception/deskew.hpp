#pragma once

#include <functional>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/scan_rules.hpp"

namespace lstm_planner {

/// Corrects the distortion of a scan that was taken while the robot moved: afterwards the ranges are as if all beams
/// had been measured at the stamp; they are measured at `rules.beam_times`, and without these nothing changes.
/// `pose_at`: where the base was at a time (s), in any frame that rests. A return moves to the nearest beam, and the
/// nearest return counts for a beam; a beam where nothing was measured holds kNotMeasured. A motion of less than half a
/// beam and 5 mm changes nothing; a scan that checkScan() refuses stays as it is.
void deskew(const SensorMount& mount, const ScanRules& rules, const std::function<Pose2(double)>& pose_at,
            LaserScan* scan);

/// No driver's reading for anything: no measurement by all ScanRules.
constexpr float kNotMeasured = -1.0f;

}  // namespace lstm_planner
