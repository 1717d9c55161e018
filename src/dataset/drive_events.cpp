#include "lstm_planner/dataset/drive_events.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {

namespace {

// Transforms and distances of what is measured remain below kLargestNumber, which is what readers take.
constexpr double kLargestMeasured = 0.1 * kLargestNumber;
constexpr std::size_t kLongestName = 1000;

bool isMeasured(double number) { return std::abs(number) <= kLargestMeasured; }

bool isMeasured(const Pose2& pose) { return isMeasured(pose.x) && isMeasured(pose.y) && isMeasured(pose.yaw); }

std::string flawOf(const OdometryHeard& odometry) {
  const bool is_fine = isInReach(odometry.pose) && isMeasured(odometry.pose) && isMeasured(odometry.twist.linear) &&
                       isMeasured(odometry.twist.angular);
  return is_fine ? "" : "the odometry has a pose or twist that is not finite or too large, or a zero quaternion";
}

std::string flawOf(const GoalHeard& goal) {
  if (goal.goal.frame.size() > kLongestName) return "the goal's frame has a name of more than 1000 letters";
  return isMeasured(goal.goal.pose) ? "" : "the goal is not finite or too far away";
}

std::string flawOf(const GoalGivenUp&) { return ""; }

std::string flawOf(const ScanHeard& heard) {
  const LaserScan& scan = heard.scan;
  if (heard.frame.size() > kLongestName) return "the scan's frame has a name of more than 1000 letters";
  if (scan.ranges.size() > static_cast<std::size_t>(kMostBeams)) {
    return "the scan has " + std::to_string(scan.ranges.size()) + " beams, expected at most " +
           std::to_string(kMostBeams);
  }
  // +inf is a range_max that some simulators have.
  const bool is_fine = isMeasured(scan.angle_min) && isMeasured(scan.angle_increment) && isMeasured(scan.range_min) &&
                       !std::isnan(scan.range_max) && isMeasured(heard.mount.pose);
  return is_fine ? "" : "the scan's angles or limits, or the scanner's place, are not finite or too large";
}

}  // namespace

std::string flawOf(const DriveEvent& event) {
  if (!(std::abs(stampOf(event)) <= kLargestNumber)) return "a stamp is not finite or too large";
  return std::visit([](const auto& heard) { return flawOf(heard); }, event);
}

EventOrder::Verdict EventOrder::add(DriveEvent event) {
  const double stamp = stampOf(event);
  if (newest_ && std::abs(stamp - *newest_) > horizon_) return Verdict::kClockSet;
  if (taken_ && stamp < *taken_) return Verdict::kLate;
  newest_ = newest_ ? std::max(*newest_, stamp) : stamp;
  const auto key = std::make_pair(stamp, event.index());
  events_.emplace(key, std::move(event));
  return Verdict::kTaken;
}

std::optional<DriveEvent> EventOrder::take(bool all) {
  if (events_.empty()) return std::nullopt;
  const bool is_due = events_.begin()->first.first <= *newest_ - delay_ || events_.size() > kMostWaiting;
  if (!is_due && !all) return std::nullopt;
  std::optional<DriveEvent> event = std::move(events_.begin()->second);
  taken_ = events_.begin()->first.first;
  events_.erase(events_.begin());
  return event;
}

void EventOrder::clear() {
  events_.clear();
  newest_.reset();
  taken_.reset();
}

}  // namespace lstm_planner
