#include "lstm_planner/drive/perception/out_of_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lstm_planner {

namespace {

constexpr std::size_t kMost = 2000;   // points
constexpr double kSamePlace = 0.01;   // m
constexpr double kHiddenBy = 0.1;     // m of air between what hides a return and the return
constexpr std::size_t kCompared = 8;  // neighbours in a scan lie beside each other

double squaredLength(const Point2& point) { return point.x * point.x + point.y * point.y; }

}  // namespace

bool OutOfView::isInView(const RangeProfile& profile, const Point2& place) {
  const long beam = profile.beamTowards(directionTo(profile.origin, place));
  if (beam < 0) return false;
  const auto i = static_cast<std::size_t>(beam);
  const float range = profile.ranges[i];
  if (!(range > 0.0F)) return false;  // not measured
  return range > distanceBetween(profile.origin, place) - kHiddenBy;
}

bool OutOfView::isInView(const Situation& situation, const Point2& place) {
  return isInView(situation.profile, place) ||
         std::any_of(situation.second.begin(), situation.second.end(),
                     [&](const SecondView& view) { return isInView(view.profile, place); });
}

void OutOfView::show(const Situation& situation) {
  old_.assign(seen_last_.begin(), seen_last_.end());  // newest first: beyond kMost the oldest give way
  old_.insert(old_.end(), points_.begin(), points_.end());
  points_.clear();
  const Pose2 before = compose(inverse(situation.pose), pose_);
  for (const Point2& point : old_) {
    const Point2 place = toParentFrame(before, point);
    if (points_.size() >= kMost || squaredLength(place) > near_ * near_ || isInView(situation, place)) continue;
    const std::size_t first = points_.size() - std::min(points_.size(), kCompared);
    const bool is_known = std::any_of(points_.begin() + static_cast<std::ptrdiff_t>(first), points_.end(),
                                      [&](const Point2& other) { return distanceBetween(place, other) < kSamePlace; });
    if (!is_known) points_.push_back(place);
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
