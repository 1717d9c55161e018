#include "lstm_planner/drive/perception/odometry_history.hpp"

#include <algorithm>

#include "lstm_planner/drive/perception/odometry_jump.hpp"

namespace lstm_planner {

namespace {

constexpr double kKept = 1.0;            // s
constexpr std::size_t kMostKept = 2000;  // entries: where stamps hardly go on, the oldest are forgotten
constexpr double kContinued = 0.2;       // s
constexpr double kOvertaken = 0.5;       // s by which a stamp is too early: a clock set right, an EKF that smooths
constexpr double kSpeedOver = 0.05;      // s, at least, from which a speed is taken

Pose2 between(const OdometryHistory::Entry& a, const OdometryHistory::Entry& b, double stamp) {
  const double share = (stamp - a.stamp) / (b.stamp - a.stamp);
  return {a.pose.x + share * (b.pose.x - a.pose.x), a.pose.y + share * (b.pose.y - a.pose.y),
          normalizeAngle(a.pose.yaw + share * normalizeAngle(b.pose.yaw - a.pose.yaw))};
}

}  // namespace

void OdometryHistory::restart() {
  if (entries_.empty()) return;
  ++jumps_;
  entries_.clear();
  twist_.restart();
}

void OdometryHistory::add(const Entry& entry) {
  if (isOvertaken(entry)) return;
  if (!entries_.empty() && !follows(entry)) restart();
  twist_.note(entry.stamp, entry.pose, entry.twist);
  if (!entries_.empty() && entry.stamp == newest().stamp) {
    entries_.back() = entry;
    return;
  }
  entries_.push_back(entry);
  while (entries_.front().stamp < entry.stamp - kKept || entries_.size() > kMostKept) {
    entries_.pop_front();
  }
}

bool OdometryHistory::isOvertaken(const Entry& entry) const {
  return !entries_.empty() && entry.stamp < newest().stamp && newest().stamp - entry.stamp <= kOvertaken;
}

bool OdometryHistory::follows(const Entry& entry) const {
  const double elapsed = entry.stamp - newest().stamp;
  return elapsed >= 0.0 && !isOdometryJump(newest().pose, entry.pose, elapsed, max_speed_);
}

Pose2 OdometryHistory::poseAt(double stamp) const {
  if (entries_.size() == 1 || stamp <= entries_.front().stamp) {
    return entries_.front().pose;
  }
  if (stamp > newest().stamp) {
    // Drivers that read several packets at once stamp them at nearly the same time: no speed is between these.
    const auto next = std::upper_bound(entries_.begin(), entries_.end(), newest().stamp - kSpeedOver,
                                       [](double time, const Entry& entry) { return time < entry.stamp; });
    if (next == entries_.begin()) return newest().pose;
    return between(*(next - 1), newest(), std::min(stamp, newest().stamp + kContinued));
  }
  const auto later = std::lower_bound(entries_.begin() + 1, entries_.end() - 1, stamp,
                                      [](const Entry& entry, double time) { return entry.stamp < time; });
  return between(*(later - 1), *later, stamp);
}

}  // namespace lstm_planner
