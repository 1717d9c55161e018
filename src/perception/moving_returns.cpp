#include "lstm_planner/perception/moving_returns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/parameter_check.hpp"

namespace lstm_planner {

namespace {

constexpr double kViewSpacing = 0.05;   // s between the scans that are kept
constexpr double kFastestRobot = 2.0;   // m/s; odometry that is faster has jumped
constexpr double kPlaceSpacing = 0.08;  // m between remembered places
constexpr double kSameThing = 0.15;     // m; a return this near to a place, or to the next return, belongs to it
constexpr std::size_t kMostGap = 2;     // beams of a moving thing that may be missing or in doubt between two

}  // namespace

void validate(const MovingReturnsParameters& parameters) {
  checkPositive("moving/range", parameters.range);
  checkPositive("moving/youngest", parameters.youngest);
  checkParameter(parameters.oldest > parameters.youngest, "moving/oldest", parameters.oldest, "more than youngest");
  checkPositive("moving/range_margin", parameters.range_margin);
  checkPositive("moving/lateral_margin", parameters.lateral_margin);
  checkPositive("moving/angle_margin", parameters.angle_margin);
  checkParameter(parameters.fewest_beams >= 1, "moving/fewest_beams", parameters.fewest_beams, "1 or more");
  checkParameter(parameters.hold >= 0.0, "moving/hold", parameters.hold, "0 or more");
}

MovingReturns::MovingReturns(const MovingReturnsParameters& parameters)
    : parameters_((validate(parameters), parameters)) {}

void MovingReturns::reset() {
  views_.clear();
  places_.clear();
  points_.clear();
}

void MovingReturns::show(const RangeProfile& profile, const Pose2& pose, double time) {
  if (!isFinite(pose) || !std::isfinite(time)) {
    return reset();
  }
  if (!views_.empty()) {
    const View& last = views_.back();
    const double elapsed = time - last.time;
    if (elapsed < 0.0 || distanceBetween(last.pose, pose) > kFastestRobot * std::max(elapsed, kViewSpacing)) {
      reset();
    }
  }
  while (!views_.empty() && time - views_.front().time > parameters_.oldest) {
    views_.pop_front();
  }
  references_.clear();
  for (const View& view : views_) {
    if (time - view.time >= parameters_.youngest) {
      references_.push_back(&view);
    }
  }
  // The oldest sees the slowest motion, the youngest what came into sight just now; those between add little.
  if (references_.size() > 2) {
    references_ = {references_.front(), references_.back()};
  }
  const View view(profile, pose, time);
  findMoving(view);
  references_.clear();
  forgetPlaces(view);
  collectPoints(view);
  if (views_.empty() || time - views_.back().time >= kViewSpacing) {
    views_.push_back(view);
  }
}

MovingReturns::Sight MovingReturns::sightOf(const Point2& point, const View& view) const {
  const RangeProfile& profile = view.profile;
  const Point2 local = view.toBase(point);
  const double distance = distanceBetween(profile.origin, local);
  const double direction = directionTo(profile.origin, local);
  const double aside = parameters_.angle_margin + parameters_.lateral_margin / std::max(distance, 0.1);
  const long center = profile.beamTowards(direction);
  if (center < 0) {
    return Sight::kUnknown;
  }
  const long half = std::lround(aside / std::abs(profile.increment));
  const long first = center - half;
  const long last = center + half;
  if (first < 0 || last >= static_cast<long>(profile.ranges.size())) {
    return Sight::kUnknown;
  }
  long known = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (long beam = first; beam <= last; ++beam) {
    const double range = profile.ranges[static_cast<std::size_t>(beam)];
    if (range > 0.0) {
      ++known;
      nearest = std::min(nearest, range);
    }
  }
  if (2 * known <= last - first || nearest < distance - parameters_.range_margin) {
    return Sight::kUnknown;  // lost, or hidden behind something
  }
  return nearest > distance + parameters_.range_margin ? Sight::kFree : Sight::kTaken;
}

bool MovingReturns::wasSeenFree(const Point2& point) const {
  for (const View* view : references_) {
    // Nearly every return stands where it stood: one beam tells.
    const Point2 local = view->toBase(point);
    const long beam = view->profile.beamTowards(directionTo(view->profile.origin, local));
    const double needed = distanceBetween(view->profile.origin, local) + parameters_.range_margin;
    const double range = beam < 0 ? 0.0 : view->profile.ranges[static_cast<std::size_t>(beam)];
    if ((range == 0.0 || range > needed) && sightOf(point, *view) == Sight::kFree) {
      return true;
    }
  }
  return false;
}

void MovingReturns::findMoving(const View& view) {
  returns_.clear();
  const RangeProfile& profile = view.profile;
  std::vector<Point2> group;
  std::size_t last_beam = 0;
  const auto closeGroup = [&] {
    if (static_cast<int>(group.size()) >= parameters_.fewest_beams) {
      for (const Point2& point : group) notePlace(point, view.time);
    }
    group.clear();
  };
  for (std::size_t beam = 0; beam < profile.ranges.size(); ++beam) {
    const double range = profile.ranges[beam];
    if (!(range > 0.0) || range > parameters_.range) {
      continue;
    }
    const Point2 local = pointAlong(profile.origin, profile.direction(beam), range);
    const Point2 point{view.pose.x + view.cosine * local.x - view.sine * local.y,
                       view.pose.y + view.sine * local.x + view.cosine * local.y};
    returns_.push_back(point);
    if (!wasSeenFree(point)) {
      continue;
    }
    if (!group.empty() && (beam - last_beam > kMostGap + 1 || distanceBetween(group.back(), point) > kSameThing)) {
      closeGroup();
    }
    group.push_back(point);
    last_beam = beam;
  }
  closeGroup();
}

void MovingReturns::notePlace(const Point2& point, double time) {
  for (Place& place : places_) {
    if (distanceBetween(place.point, point) < kPlaceSpacing) {
      place.time = time;
      return;
    }
  }
  places_.push_back({point, time});
}

void MovingReturns::forgetPlaces(const View& view) {
  const auto over = [&](const Place& place) {
    return view.time - place.time > parameters_.hold ||
           (place.time < view.time && sightOf(place.point, view) == Sight::kFree);
  };
  places_.erase(std::remove_if(places_.begin(), places_.end(), over), places_.end());
}

void MovingReturns::collectPoints(const View& view) {
  points_.clear();
  if (places_.empty()) {
    return;
  }
  for (const Point2& point : returns_) {
    const auto near = [&](const Place& place) { return distanceBetween(place.point, point) < kSameThing; };
    if (std::any_of(places_.begin(), places_.end(), near)) {
      points_.push_back(view.toBase(point));
    }
  }
  for (const Place& place : places_) {
    if (sightOf(place.point, view) == Sight::kUnknown) {
      points_.push_back(view.toBase(place.point));
    }
  }
}

}  // namespace lstm_planner
