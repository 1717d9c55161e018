#pragma once

#include <tf2/buffer_core.h>

#include <map>
#include <string>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// Whether a transform of a part of the robot has changed by more than rounding (1 mm, 0.002 rad).
bool differ(const Pose2& one, const Pose2& other);

/// Where scanners sit on the robot, by the newest transforms. Says so when one moves or is corrected.
class ScannerMounts {
 public:
  /// `tf` must outlive the object. `base_frame` stands in where nothing names the robot's frame, or names one that tf
  /// does not know.
  ScannerMounts(const tf2::BufferCore& tf, const std::string& base_frame)
      : tf_(tf), stand_in_(base_frame), base_frame_(base_frame) {}

  /// The robot's frame has this name; nothing happens where it is empty.
  void setBaseFrame(const std::string& base_frame);

  /// Of the scanner in that frame; the last known one while tf does not know it. Throws SensorError if there is none.
  const SensorMount& at(const std::string& frame);

 private:
  SensorMount lookUp(const std::string& base_frame, const std::string& frame) const;
  SensorMount lookUp(const std::string& frame) const;

  const tf2::BufferCore& tf_;
  const std::string stand_in_;
  std::string base_frame_;
  std::map<std::string, SensorMount> mounts_;  ///< by the scanner's frame
};

}  // namespace lstm_planner
