#pragma once

#include <string>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// Writes one row for each step, below a line with the names of the columns: recording and episode (counted from 0),
/// number, and the columns of the table steps. Numbers read back exactly; what was not measured is empty. `with_scans`:
/// also beam_0, beam_1 ..., m. Discarded episodes are left out. Throws DatasetError if the file cannot be written.
void exportCsv(const std::string& path, const Dataset& dataset, bool with_scans);

/// Writes arrays for numpy.load(), N steps long. Discarded episodes are left out. Throws DatasetError if the file
/// cannot be written.
///
///   recording, episode, number (N,) int64       episode counts over all recordings, from 0
///   stamp, next_stamp (N,) float64              s
///   pose, next_pose (N, 3) float64              m, m, rad, odometry frame
///   twist (N, 2) float64                        m/s, rad/s
///   goal (N, 2) float64                         m, odometry frame
///   sector_range, minimum_range (N, 8) float64  m, right to left; inf where nothing was measured
///   beams, measured (N, 8) int64
///   goal_distance, goal_bearing, heading, previous_action, route_bearing, route_length (N,) float64   m or rad
///   visits (N, 8) float64
///   driven_angle (N,) float64, label (N,) int64
///   action_angles (A,) float64                  rad, the angle of each label; of the first recording
///   with scans: ranges (N, B) float32           m, NaN beyond a scan's own beams
///               scan_geometry (N, 9) float64    angle_min, angle_increment [rad], beams, range_min, range_max [m],
///                                               mount x, y [m], yaw [rad], upside down (0, 1)
void exportNumpy(const std::string& path, const Dataset& dataset, bool with_scans);

}  // namespace lstm_planner
