#include "lstm_planner/drive/motion/trail.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {

namespace {

constexpr double kSpacing = 0.02;   // m between poses, at the least
constexpr double kTurn = 0.05;      // rad, likewise
constexpr double kSpacings = 75.0;  // that are remembered: 1.5 m, or half a turn in place and 0.2 m
constexpr double kThere = 0.5;      // spacings; nearer than that the robot is there
constexpr double kAhead = 5.0;      // spacings to the pose that it goes back to
constexpr double kOff = 1.0;        // spacings; farther from where it was it does not know what is behind it
constexpr double kOffBack = 2.5;    // spacings, of a robot that goes back already: it cuts corners

/// In spacings.
double apart(const Pose2& a, const Pose2& b) {
  return std::hypot(distanceBetween(a, b) / kSpacing, normalizeAngle(a.yaw - b.yaw) / kTurn);
}

}  // namespace

void Trail::note(const Pose2& pose, bool goes_back) {
  cutLoop(pose);
  const auto isPassed = [&] {
    const double last = apart(pose, places_.back().pose);
    const bool is_nearer_before = places_.size() > 1 && apart(pose, places_[places_.size() - 2].pose) < last;
    return last < kThere || is_nearer_before;
  };
  if (goes_back) {
    while (!places_.empty() && isPassed()) places_.pop_back();
    return;
  }
  const double on = places_.empty() ? kSpacings : apart(pose, places_.back().pose);
  if (on < 1.0) return;
  places_.push_back({pose, places_.empty() ? 0.0 : places_.back().along + on});
  while (places_.back().along - places_.front().along > kSpacings) places_.pop_front();
}

/// Who is back where it was needs no way back to what it did in between: who tries to turn in a passage, to and fro,
/// would forget how it came there.
void Trail::cutLoop(const Pose2& pose) {
  const auto first =
      std::find_if(places_.begin(), places_.end(), [&](const Place& place) { return apart(pose, place.pose) < kOff; });
  if (first != places_.end()) places_.erase(first + 1, places_.end());
}

std::optional<Pose2> Trail::back(const Pose2& pose, bool goes_back) const {
  const double off = goes_back ? kOffBack : kOff;
  const auto isNear = [&](const Place& place) { return apart(pose, place.pose) <= off; };
  if (std::none_of(places_.begin(), places_.end(), isNear)) return std::nullopt;
  // Not the very next one: over so short a way the direction is noise.
  for (auto place = places_.rbegin(); place != places_.rend(); ++place) {
    if (apart(pose, place->pose) >= kAhead) return compose(inverse(pose), place->pose);
  }
  return std::nullopt;
}

bool Trail::endsAt(const Pose2& pose) const { return !places_.empty() && apart(pose, places_.front().pose) < kAhead; }

std::vector<Pose2> Trail::seenFrom(const Pose2& pose) const {
  std::vector<Pose2> poses;
  for (const Place& place : places_) poses.push_back(compose(inverse(pose), place.pose));
  return poses;
}

}  // namespace lstm_planner
