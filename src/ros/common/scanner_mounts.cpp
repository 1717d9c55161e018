#include "lstm_planner/ros/common/scanner_mounts.hpp"

#include <ros/console.h>
#include <tf2/exceptions.h>

#include <cmath>
#include <stdexcept>

#include "lstm_planner/drive/perception/message_age.hpp"
#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {

namespace {

constexpr double kWarningPeriod = 30.0;  // s

}  // namespace

bool differ(const Pose2& one, const Pose2& other) {
  constexpr double kSamePlace = 0.001;      // m
  constexpr double kSameDirection = 0.002;  // rad
  return distanceBetween(one, other) > kSamePlace || turnBetween(one, other) > kSameDirection;
}

void ScannerMounts::setBaseFrame(const std::string& base_frame) {
  if (base_frame.empty() || base_frame == base_frame_) return;
  base_frame_ = base_frame;
  mounts_.clear();
}

SensorMount ScannerMounts::lookUp(const std::string& base_frame, const std::string& frame) const {
  const SensorMount mount = mountFromMessage(tf_.lookupTransform(base_frame, frame, ros::Time(0)).transform);
  if (!isFinite(mount.pose)) {
    throw std::invalid_argument("the transform from " + frame + " to " + base_frame + " is not finite");
  }
  return mount;
}

SensorMount ScannerMounts::lookUp(const std::string& frame) const {
  try {
    return lookUp(base_frame_, frame);
  } catch (const tf2::LookupException&) {
    if (base_frame_ == stand_in_) throw;
    const SensorMount mount = lookUp(stand_in_, frame);
    ROS_WARN_ONCE("the odometry calls the robot %s (child_frame_id), which tf does not connect with %s: %s is taken",
                  base_frame_.c_str(), frame.c_str(), stand_in_.c_str());
    return mount;
  }
}

const SensorMount& ScannerMounts::at(const std::string& frame) {
  constexpr std::size_t kMostScanners = 16;
  const auto known = mounts_.find(frame);
  try {
    const SensorMount mount = lookUp(frame);
    if (known == mounts_.end()) {
      if (mounts_.size() >= kMostScanners) mounts_.clear();
      return mounts_.emplace(frame, mount).first->second;
    }
    if (differ(mount.pose, known->second.pose)) {
      ROS_WARN_THROTTLE(kWarningPeriod, "the transform from %s to %s has changed: the scanner moves, or was corrected",
                        frame.c_str(), base_frame_.c_str());
    }
    return known->second = mount;
  } catch (const tf2::TransformException& error) {
    if (known != mounts_.end()) return known->second;  // tf forgets all when the clock is set back
    throw SensorError("the pose of the scanner is not known: " + std::string(error.what()));
  } catch (const std::invalid_argument& error) {
    throw SensorError(error.what());
  }
}

}  // namespace lstm_planner
