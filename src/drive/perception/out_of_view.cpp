#include "lstm_planner/drive/perception/out_of_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lstm_planner {

namespace {

constexpr std::size_t kMost = 2000;  // points
constexpr double kSamePlace = 0.01;  // m
constexpr double kHiddenBy = 0.1;    // m of air between what hides a return and the return

double squaredLength(const Point2& point) { return point.x * point.x + point.y * point.y; }

bool isInView(const RangeProfile& profile, const Point2& place) {
  const double direction = directionTo(profile.origin, place);
  // Beside the last beam nothing is in view, however near: what a slow turn takes out of view leaves it there.
  if (!profile.isInView(direction)) return false;
  const long beam = profile.beamTowards(direction);
  const auto i = static_cast<std::size_t>(beam);
  const float range = profile.ranges[i];
  if (!(range > 0.0F)) return false;  // not measured
  return range > distanceBetween(profile.origin, place) - kHiddenBy;
}

bool isInView(const Situation& situation, const Point2& place) {
  return isInView(situation.profile, place) || isInView(situation.second.profile, place);
}

}  // namespace

void OutOfView::show(const Situation& situation) {
  const Pose2 before = compose(inverse(situation.pose), pose_);
  const auto matters = [&](const Point2& place) {
    return squaredLength(place) <= near_ * near_ && !isInView(situation, place);
  };
  // A return beside a remembered one adds nothing, and must not replace it: in a slow turn each one is beside the next.
  const auto isKnown = [this](const Point2& place) {
    return std::any_of(points_.begin(), points_.end(),
                       [&](const Point2& other) { return distanceBetween(place, other) < kSamePlace; });
  };
  const std::vector<Point2> old = std::move(points_);
  points_.clear();
  for (const Point2& point : old) {
    const Point2 place = toParentFrame(before, point);
    if (matters(place)) points_.push_back(place);
  }
  for (const Point2& point : seen_last_) {
    const Point2 place = toParentFrame(before, point);
    if (matters(place) && !isKnown(place)) points_.push_back(place);
  }
  if (points_.size() > kMost) {  // the oldest give way
    points_.erase(points_.begin(), points_.end() - static_cast<std::ptrdiff_t>(kMost));
  }
  seen_last_.clear();
  for (const Point2& point : situation.obstacles) {
    if (squaredLength(point) <= near_ * near_) seen_last_.push_back(point);
  }
  pose_ = situation.pose;
}

void OutOfView::forget() {
  points_.clear();
  seen_last_.clear();
}

}  // namespace lstm_planner
