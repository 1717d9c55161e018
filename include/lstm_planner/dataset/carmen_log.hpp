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

/// The drive that a log of the CARMEN toolkit tells, the text format of the classic data sets of laser scans
/// (http://carmen.sourceforge.net/logger_playback.html): the lines FLASER or ROBOTLASER1, and ODOM.
struct CarmenLog {
  std::vector<DriveEvent> events;  ///< odometry and scans in the order of the lines; the frames are "odom" and "laser"
  std::string scan_kind;           ///< "FLASER" or "ROBOTLASER1": which comes first; the other one is ignored
  long scans = 0;
  long odometry = 0;                    ///< lines ODOM that are used
  double duration = 0.0;                ///< s
  bool mount_known = false;             ///< false: nothing says where the scanner sits; taken as the base's origin
  std::map<std::string, long> ignored;  ///< other lines by their first word, "#" for comments,
                                        ///< "?" for what is no keyword, or one too many
  long repeated = 0;   ///< lines ODOM left out: they repeat the pose of the scan before them, and programs that
                       ///< correct poses insert such lines with stamps that mean nothing
  long late = 0;       ///< lines with a stamp later than that of a line behind them; see readCarmenLog()
  long standing = 0;   ///< scans stamped no later than the scan before; if most are, the log's times are lost
  long malformed = 0;  ///< lines that do not have the numbers they should; left out
  std::string first_malformed;  ///< "line N: ", and why
};

/// Reads a log, plain or compressed by gzip.
///
/// - Stamps are those of the messages (ipc_timestamp). Some loggers stamp single messages up to a second late, which
///   shows when the next line has an earlier stamp. The order of the lines is right, the poses in it are smooth: such a
///   line gets the stamp in between its neighbours. A stamp more than 5 s earlier is a clock that was set.
/// - Poses are those of the robot's odometry: ODOM x y theta, FLASER and ROBOTLASER1 odom_x odom_y odom_theta. In
///   published logs a mapping program often has corrected them. A scan's own pose is odometry at the scan's stamp.
/// - Speeds are differences of poses, since correcting these leaves none that fit.
/// - FLASER does not say its angles: 180 or 181 readings are 1 degree apart, 360 or 361 half a degree, 400 or 401 a
///   quarter, others 180 degrees altogether, ahead in the middle, as CARMEN itself guesses for SICK's scanners.
/// - ROBOTLASER1 says the angle between two readings (angular_resolution, rad). Where that field is the number of
///   readings, or of the angles between them, the angle is that part of the field of view.
/// - Nothing came back where a reading is the largest possible or more. FLASER does not say that either: 50 m, at which
///   some logs are cut, less than the scanner's own codes (81.83, 81.91).
/// - The scanner sits at `mount`; else where ROBOTLASER1 has laser and robot; else at PARAM robot_frontlaser_offset (m
///   ahead); else at the base's origin.
///
/// Throws std::invalid_argument naming the file when it cannot be read, holds no scans, or is longer than 256 MiB
/// (decompressed) or a million scans and lines ODOM.
CarmenLog readCarmenLog(const std::string& path, const std::optional<SensorMount>& mount = std::nullopt);

/// What readings mean in such logs: the largest possible ones, that nothing came back.
ScanRules carmenLogRules();

/// Gives a log to a recorder, with goals found in hindsight: logs name none.
void recordCarmenLog(const CarmenLog& log, const HindsightParameters& hindsight, const RecorderParameters& parameters,
                     StepSink* sink);

}  // namespace lstm_planner
