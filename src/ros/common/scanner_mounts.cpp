#include "lstm_planner/ros/common/scanner_mounts.hpp"

#include <tf2/exceptions.h>

#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {

void ScannerMounts::setBaseFrame(const std::string& base_frame) {
  if (base_frame.empty() || base_frame == base_frame_) return;
  base_frame_ = base_frame;
  mounts_.clear();
}

const SensorMount& ScannerMounts::at(const std::string& frame) {
  constexpr std::size_t kMostScanners = 16;
  const auto known = mounts_.find(frame);
  if (known != mounts_.end()) return known->second;
  SensorMount mount;
  try {
    mount = mountFromMessage(tf_.lookupTransform(base_frame_, frame, ros::Time(0)).transform);
  } catch (const tf2::TransformException& error) {
    throw MountUnknown("the pose of the scanner is not known: " + std::string(error.what()));
  } catch (const std::invalid_argument& error) {
    throw MountUnknown(error.what());
  }
  if (!isFinite(mount.pose)) {
    throw MountUnknown("the transform from " + frame + " to " + base_frame_ + " is not finite");
  }
  if (mounts_.size() >= kMostScanners) mounts_.clear();
  return mounts_.emplace(frame, mount).first->second;
}

}  // namespace lstm_planner
