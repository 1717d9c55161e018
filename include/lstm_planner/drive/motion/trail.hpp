#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// The last 1.5 m of the path that a robot came, as poses in the odometry frame: where it was nothing stands, and how
/// it came it can go back, also where it does not see. Loops are cut: what it did between two visits of a place is no
/// way back.
class Trail {
 public:
  /// The robot is here now. `goes_back`: it retraces the trail, which becomes shorter instead of longer.
  void note(const Pose2& pose, bool goes_back) {
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

  /// The next pose back, in the robot's frame; none at the trail's end, nor where the robot is farther than 2 cm or
  /// 0.05 rad from each pose of the trail, 2.5 times that if it goes back already. A robot that stops there, and is
  /// noted, may go on back from there. The pose lies ahead where the robot had driven backwards.
  std::optional<Pose2> back(const Pose2& pose, bool goes_back = false) const {
    const double off = goes_back ? kOffBack : kOff;
    const auto isNear = [&](const Place& place) { return apart(pose, place.pose) <= off; };
    if (std::none_of(places_.begin(), places_.end(), isNear)) return std::nullopt;
    // Not the very next one: over so short a way the direction is noise.
    for (auto place = places_.rbegin(); place != places_.rend(); ++place) {
      if (apart(pose, place->pose) >= kAhead) return compose(inverse(pose), place->pose);
    }
    return std::nullopt;
  }

  /// Its poses as seen from one of them or from elsewhere, oldest first.
  std::vector<Pose2> seenFrom(const Pose2& pose) const {
    std::vector<Pose2> poses;
    for (const Place& place : places_) poses.push_back(compose(inverse(pose), place.pose));
    return poses;
  }

  /// Whether a robot there has gone back all of it, to within five spacings, as back() leads it.
  bool endsAt(const Pose2& pose) const { return !places_.empty() && apart(pose, places_.front().pose) < kAhead; }

  bool isEmpty() const { return places_.empty(); }

  /// The odometry jumped.
  void clear() { places_.clear(); }

 private:
  static constexpr double kSpacing = 0.02;   // m between poses, at the least
  static constexpr double kTurn = 0.05;      // rad, likewise
  static constexpr double kSpacings = 75.0;  // that are remembered: 1.5 m, or half a turn in place and 0.2 m
  static constexpr double kThere = 0.5;      // spacings; nearer than that the robot is there
  static constexpr double kAhead = 5.0;      // spacings to the pose that it goes back to
  static constexpr double kOff = 1.0;        // spacings; farther from where it was it does not know what is behind it
  static constexpr double kOffBack = 2.5;    // spacings, of a robot that goes back already: it cuts corners

  /// In spacings.
  static double apart(const Pose2& a, const Pose2& b) {
    return std::hypot(distanceBetween(a, b) / kSpacing, normalizeAngle(a.yaw - b.yaw) / kTurn);
  }

  /// One of its poses.
  struct Place {
    Pose2 pose;
    double along;  ///< in spacings, from wherever the trail began
  };
  /// Who is back where it was needs no way back to what it did in between: who tries to turn in a passage, to and fro,
  /// would forget how it came there.
  void cutLoop(const Pose2& pose) {
    const auto first = std::find_if(places_.begin(), places_.end(),
                                    [&](const Place& place) { return apart(pose, place.pose) < kOff; });
    if (first != places_.end()) places_.erase(first + 1, places_.end());
  }

  std::deque<Place> places_;  ///< oldest first
};

}  // namespace lstm_planner
