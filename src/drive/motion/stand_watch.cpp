#include "lstm_planner/drive/motion/stand_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lstm_planner {

namespace {

constexpr double kMoved = 0.1;          // m; more than odometry's noise, less than the slowest robot drives in seconds
constexpr double kTurned = 0.3;         // rad
constexpr double kSameGoal = 0.25;      // m
constexpr std::size_t kMostPlaces = 8;  // less than 1 m

}  // namespace

void StandWatch::note(const Pose2& pose, double time, const Point2& goal, bool is_commanded) {
  if (distanceBetween(goal_, goal) > kSameGoal || time < now_) clear();
  goal_ = goal;
  now_ = time;
  if (isNew(pose)) {
    since_.reset();
    retries_ = 0;
  }
  if (!since_) {
    since_ = time;
    tried_.reset();
  }
  if (is_commanded && !tried_) tried_ = time;
}

/// Where it has just been it gets away from nothing: it may turn to and fro, or drive. Who looks around turns on.
bool StandWatch::isNew(const Pose2& pose) {
  heading_ += normalizeAngle(pose.yaw - heading_);
  const auto known = std::find_if(places_.begin(), places_.end(),
                                  [&](const Place& place) { return distanceBetween(place.position, pose) <= kMoved; });
  if (known == places_.end()) {
    places_.push_back({{pose.x, pose.y}, heading_, heading_});
    if (places_.size() > kMostPlaces) places_.pop_front();
    return true;
  }
  const bool turns_on = heading_ < known->rightmost - kTurned || heading_ > known->leftmost + kTurned;
  if (turns_on) {
    known->rightmost = std::min(known->rightmost, heading_);
    known->leftmost = std::max(known->leftmost, heading_);
  }
  return turns_on;
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
