#include "drive/perception/seen_free.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {

namespace {

constexpr double kLookSpacing = 0.05;  // m between the places that are looked at
constexpr double kAirBehind = 0.05;    // m of air behind a place that is free

bool isSeenFree(const RangeProfile& profile, const Point2& place) {
  const double distance = distanceBetween(profile.origin, place) + kAirBehind;
  const long beam = profile.beamTowards(directionTo(profile.origin, place));
  if (beam < 0 || distance > profile.farthest_range) return false;
  bool is_measured = false;
  for (long counted = beam - 1; counted <= beam + 1; ++counted) {
    const long i = profile.beamAt(counted);
    if (i < 0) continue;
    const double range = profile.ranges[static_cast<std::size_t>(i)];
    if (range == RangeProfile::kSilent || range == 0.0) continue;
    if (range < distance) return false;
    is_measured = true;
  }
  return is_measured;
}

}  // namespace

bool isSeenFree(const Situation& situation, const Point2& place) {
  return isSeenFree(situation.profile, place) || isSeenFree(situation.second.profile, place);
}

double seenFreeBehind(const Situation& situation, const Footprint& footprint, double margin, double limit) {
  const double half_width = footprint.passingRadius() + margin;
  // To its rearmost point, along the axis: nothing of it is farther behind.
  const double rear = footprint.circumscribedRadius() + margin;
  double back = 0.0;
  for (; back <= rear + limit; back += kLookSpacing) {
    for (double aside = -half_width; aside <= half_width; aside += kLookSpacing) {
      const Point2 place{-back, aside};
      if (footprint.distanceTo(place) > 0.0 && !isSeenFree(situation, place)) {
        return std::clamp(back - kLookSpacing - rear, 0.0, limit);
      }
    }
  }
  return limit;
}

}  // namespace lstm_planner
