#pragma once

#include <tf2/buffer_core.h>

#include <map>
#include <stdexcept>
#include <string>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// It is not known where a scanner sits; what() says why.
class MountUnknown : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where scanners sit on the robot, by the transforms. Asked for once a scanner: they do not move.
class ScannerMounts {
 public:
  /// `tf` must outlive the object. `base_frame` stands in where nothing names the robot's frame.
  ScannerMounts(const tf2::BufferCore& tf, const std::string& base_frame) : tf_(tf), base_frame_(base_frame) {}

  /// The robot's frame has this name; nothing happens where it is empty.
  void setBaseFrame(const std::string& base_frame);

  /// Of the scanner in that frame. Throws MountUnknown.
  const SensorMount& at(const std::string& frame);

 private:
  const tf2::BufferCore& tf_;
  std::string base_frame_;
  std::map<std::string, SensorMount> mounts_;  ///< by the scanner's frame
};

}  // namespace lstm_planner
