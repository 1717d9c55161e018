#include "lstm_planner/drive/motion/stand_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lstm_planner {

namespace {

constexpr double kMoved = 0.05;          // m; more than odometry's noise, less than the slowest robot drives in seconds
constexpr double kTurned = 0.3;          // rad
constexpr double kSameGoal = 0.25;       // m
constexpr std::size_t kMostPlaces = 16;  // less than a turn around, and less than 1 m

bool isSamePlace(const Pose2& one, const Pose2& other) {
  return distanceBetween(one, other) <= kMoved && std::abs(normalizeAngle(one.yaw - other.yaw)) <= kTurned;
}

}  // namespace

void StandWatch::note(const Pose2& pose, double time, const Point2& goal, bool is_commanded) {
  if (distanceBetween(goal_, goal) > kSameGoal || time < now_) clear();
  goal_ = goal;
  now_ = time;
  const auto knows = [&](const Pose2& place) { return isSamePlace(place, pose); };
  // Where it has just been it gets away from nothing: it may turn to and fro, or drive.
  if (std::none_of(places_.begin(), places_.end(), knows)) {
    places_.push_back(pose);
    if (places_.size() > kMostPlaces) places_.pop_front();
    since_.reset();
    retries_ = 0;
  }
  if (!since_) {
    since_ = time;
    tried_.reset();
  }
  if (is_commanded && !tried_) tried_ = time;
}

void StandWatch::excuse(double time) {
  if (since_) since_ = time;
  tried_.reset();
}

void StandWatch::retry() {
  excuse(now_);
  ++retries_;
}

void StandWatch::clear() {
  places_.clear();
  since_.reset();
  retries_ = 0;
}

}  // namespace lstm_planner
