#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/dataset/drive_events.hpp"
#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/dataset/hindsight.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/scan_rules.hpp"

namespace lstm_planner {

/// The drive in a log of the CARMEN toolkit, the text format of the classic data sets of laser scans
/// (http://carmen.sourceforge.net/logger_playback.html): the lines FLASER or ROBOTLASER1, and ODOM.
struct CarmenLog {
  std::vector<DriveEvent> events;  ///< odometry and scans in the order of the lines; the frames are "odom" and "laser"
  std::string scan_kind;           ///< "FLASER" or "ROBOTLASER1": the kind that comes first; the other one is ignored
  long scans = 0;
  long odometry = 0;                    ///< lines ODOM that are used
  double duration = 0.0;                ///< s
  bool mount_known = false;             ///< false: the scanner's pose is unknown; the base's origin is taken
  std::map<std::string, long> ignored;  ///< other lines by their first word, "#" for comments,
                                        ///< "?" for what is not a keyword, or one too many
  long repeated = 0;   ///< lines ODOM left out: they repeat the pose of the scan before them; programs that correct
                       ///< poses insert such lines with meaningless stamps
  long late = 0;       ///< lines with a stamp later than that of a line behind them; see readCarmenLog()
  long standing = 0;   ///< scans whose stamp is not later than that of the scan before; if most are, the times are lost
  long malformed = 0;  ///< lines without the numbers that they should have; left out
  std::string first_malformed;  ///< "line N: ", and why
};

/// Reads a log, plain or compressed by gzip.
///
/// - Stamps are those of the messages (ipc_timestamp). Some loggers stamp single messages up to a second late: then the
///   next line has an earlier stamp. The order of the lines is right, as the poses in it are smooth, so such a line
///   gets a stamp between those of its neighbours. If a stamp is more than 5 s earlier, the clock was set.
/// - Poses are those of the robot's odometry: ODOM x y theta, FLASER and ROBOTLASER1 odom_x odom_y odom_theta. In
///   published logs a mapping program has often corrected them. A scan's own pose is odometry at the scan's stamp.
/// - Speeds are differences of poses, because the logged speeds do not fit corrected poses.
/// - FLASER does not say its angles: 180 or 181 readings are 1 degree apart, 360 or 361 half a degree, 400 or 401 a
///   quarter; other numbers cover 180 degrees. The middle is ahead. CARMEN itself guesses so for SICK's scanners.
/// - ROBOTLASER1 says the angle between two readings (angular_resolution, rad). If that field is the number of
///   readings, or of the angles between them, the field of view is divided by it.
/// - A reading at the largest range or more means that nothing came back. FLASER does not say that range; 50 m is
///   taken: some logs are cut there, and the scanner's own codes are larger (81.83, 81.91).
/// - The scanner's pose is `mount`; else that between robot and laser in ROBOTLASER1; else PARAM
///   robot_frontlaser_offset (m ahead); else the base's origin.
///
/// Throws std::invalid_argument naming the file if it cannot be read, holds no scans, is longer than 256 MiB
/// (decompressed), or has more than a million scans and lines ODOM.
CarmenLog readCarmenLog(const std::string& path, const std::optional<SensorMount>& mount = std::nullopt);

/// What readings mean in such logs: the largest possible ones mean that nothing came back.
ScanRules carmenLogRules();

/// Gives a log to a recorder, with goals in hindsight, because logs name no goals. Throws as hindsightGoals().
void recordCarmenLog(const CarmenLog& log, const HindsightParameters& hindsight, const RecorderParameters& parameters,
                     StepSink* sink);

}  // namespace lstm_planner
