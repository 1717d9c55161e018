#include "lstm_planner/drive/perception/moving_returns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lstm_planner/common/parameter_visitors.hpp"

namespace lstm_planner {

namespace {

constexpr double kViewSpacing = 0.05;   // s between the scans that are kept
constexpr double kLeastJump = 2.0;      // m/s; odometry that is faster than a slow robot can be has jumped
constexpr double kJump = 2.0;           // of the robot's speed, likewise
constexpr double kPlaceSpacing = 0.08;  // m between remembered places
constexpr double kSameThing = 0.15;     // m; a return this near to a place, or to the next return, belongs to it
constexpr double kApart = 0.3;          // m; returns of one thing are nearer to one another, in MovingThings, too
constexpr double kRestingReach = 1.5;   // m from the robot; what rests farther away does not matter yet
constexpr std::size_t kMostGap = 2;     // beams of a moving thing that may be missing or in doubt between two

bool isNear(const Point2& a, const Point2& b, double distance) {
  return square(b.x - a.x) + square(b.y - a.y) < square(distance);
}

}  // namespace

void validate(const MovingReturnsParameters& parameters) {
  visitMovingParameters(parameters, RangeCheck());
  checkParameter(parameters.oldest > parameters.youngest, "moving/oldest", parameters.oldest, "more than youngest");
}

MovingReturns::MovingReturns(const MovingReturnsParameters& parameters)
    : parameters_((validate(parameters), parameters)), fastest_odometry_(kLeastJump) {}

void MovingReturns::expectSpeed(double fastest) { fastest_odometry_ = std::max(kLeastJump, kJump * fastest); }

void MovingReturns::reset() {
  views_.clear();
  places_.clear();
  points_.clear();
  resting_.clear();
  returns_.clear();
  moves_.clear();
}

void MovingReturns::show(const RangeProfile& profile, const Pose2& pose, double time) {
  if (!isFinite(pose) || !std::isfinite(time)) {
    return reset();
  }
  if (!views_.empty()) {
    const View& last = views_.back();
    const double elapsed = time - last.time;
    if (elapsed < 0.0 || distanceBetween(last.pose, pose) > fastest_odometry_ * std::max(elapsed, kViewSpacing)) {
      reset();
    }
  }
  takeView(profile, pose, time);
  while (!views_.empty() && time - views_.front().time > parameters_.oldest) views_.pop_front();
  collectReturns();
  std::size_t references = 0;
  while (references < views_.size() && time - views_[references].time >= parameters_.youngest) ++references;
  // The oldest sees the slowest motion, the youngest what came into sight just now; those between add little.
  if (references > 0) compareWith(views_.front());
  if (references > 1) compareWith(views_[references - 1]);
  findMoving();
  forgetPlaces();
  collectPoints();
  if (views_.empty() || time - views_.back().time >= kViewSpacing) {
    keepView();
  }
}

void MovingReturns::takeView(const RangeProfile& profile, const Pose2& pose, double time) {
  view_.profile = profile;
  view_.pose = pose;
  view_.cosine = std::cos(pose.yaw);
  view_.sine = std::sin(pose.yaw);
  view_.time = time;
}

void MovingReturns::keepView() {
  const RangeProfile& profile = view_.profile;
  const auto margin = static_cast<float>(parameters_.range_margin);
  view_.scanner = view_.toOdometry(profile.origin);
  view_.finder = BeamFinder(profile, view_.pose.yaw);
  view_.limits.resize(profile.ranges.size());
  const auto farthest = profile.farthestRange();
  for (std::size_t beam = 0; beam < profile.ranges.size(); ++beam) {
    const float range = std::min(profile.ranges[beam], farthest);
    const float before = range > margin ? range - margin : 0.0f;
    view_.limits[beam] = range <= 0.0f ? std::numeric_limits<float>::infinity() : before * before;
  }
  views_.push_back(std::move(view_));
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
  const double beams_aside = aside / std::abs(profile.increment);
  if (beams_aside > static_cast<double>(profile.ranges.size()))
    return Sight::kUnknown;  // nor would a whole number hold it
  const long half = std::lround(beams_aside);
  const long first = center - half;
  const long last = center + half;
  if (profile.beamAt(first) < 0 || profile.beamAt(last) < 0) {
    return Sight::kUnknown;
  }
  long known = 0;
  double nearest = profile.farthest_range;
  for (long beam = first; beam <= last; ++beam) {
    const double range = profile.ranges[static_cast<std::size_t>(profile.beamAt(beam))];
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

void MovingReturns::collectReturns() {
  const RangeProfile& profile = view_.profile;
  const std::size_t beams = profile.ranges.size();
  directions_.set(profile.first_direction, profile.increment, beams);
  returns_.clear();
  beams_.clear();
  const auto farthest = static_cast<float>(parameters_.range);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const float range = profile.ranges[beam];
    if (!(range > 0.0f && range <= farthest)) continue;
    const Point2 direction = directions_[beam];
    returns_.push_back(
        view_.toOdometry({profile.origin.x + range * direction.x, profile.origin.y + range * direction.y}));
    beams_.push_back(beam);
  }
  if (profile.closes()) beginWithAThing();
  is_free_.assign(returns_.size(), 0);
}

/// Where a scan closes, what lies on both sides of its first beam is one thing: the returns begin with another one.
void MovingReturns::beginWithAThing() {
  for (std::size_t i = 1; i < returns_.size(); ++i) {
    if (distanceBetween(returns_[i - 1], returns_[i]) <= kApart) continue;
    const auto first = static_cast<std::ptrdiff_t>(i);
    std::for_each(beams_.begin(), beams_.begin() + first, [&](auto& beam) { beam += view_.profile.ranges.size(); });
    std::rotate(beams_.begin(), beams_.begin() + first, beams_.end());
    std::rotate(returns_.begin(), returns_.begin() + first, returns_.end());
    return;
  }
}

void MovingReturns::compareWith(const View& reference) {
  for (std::size_t i = 0; i < returns_.size(); ++i) {
    const auto x = static_cast<float>(returns_[i].x - reference.scanner.x);
    const auto y = static_cast<float>(returns_[i].y - reference.scanner.y);
    // Nearly every return stands where it stood: one beam tells.
    const long beam = reference.finder.beamTowards(x, y);
    if (beam >= 0 && x * x + y * y < reference.limits[static_cast<std::size_t>(beam)] && is_free_[i] == 0 &&
        sightOf(returns_[i], reference) == Sight::kFree) {
      is_free_[i] = 1;
    }
  }
}

void MovingReturns::findMoving() {
  group_.clear();
  std::size_t last_beam = 0;
  for (std::size_t i = 0; i < returns_.size(); ++i) {
    if (is_free_[i] == 0) {
      continue;
    }
    if (!group_.empty() &&
        (beams_[i] - last_beam > kMostGap + 1 || distanceBetween(group_.back(), returns_[i]) > kSameThing)) {
      closeGroup();
    }
    group_.push_back(returns_[i]);
    last_beam = beams_[i];
  }
  closeGroup();
}

void MovingReturns::closeGroup() {
  if (static_cast<int>(group_.size()) >= parameters_.fewest_beams) {
    for (const Point2& point : group_) notePlace(point);
  }
  group_.clear();
}

void MovingReturns::notePlace(const Point2& point) {
  for (Place& place : places_) {
    if (isNear(place.point, point, kPlaceSpacing)) {
      place.time = view_.time;
      return;
    }
  }
  places_.push_back({point, view_.time});
}

void MovingReturns::forgetPlaces() {
  const auto over = [&](const Place& place) {
    return view_.time - place.time > std::max(parameters_.hold, parameters_.remember) ||
           (place.time < view_.time && sightOf(place.point, view_) == Sight::kFree);
  };
  places_.erase(std::remove_if(places_.begin(), places_.end(), over), places_.end());
}

void MovingReturns::collectPoints() {
  moving_places_.clear();
  resting_places_.clear();
  for (const Place& place : places_) {
    if (view_.time - place.time <= parameters_.hold) {
      moving_places_.push_back(place.point);
    } else if (distanceBetween(place.point, view_.pose) <= kRestingReach) {
      resting_places_.push_back(place.point);
    }
  }
  moves_.assign(returns_.size(), 0);
  collectNear(moving_places_, &points_, &moves_);
  collectNear(resting_places_, &resting_, nullptr);
}

void MovingReturns::collectNear(const std::vector<Point2>& places, std::vector<Point2>* points,
                                std::vector<std::uint8_t>* is_near) const {
  points->clear();
  if (places.empty()) {
    return;
  }
  for (std::size_t i = 0; i < returns_.size(); ++i) {
    const Point2& point = returns_[i];
    const auto isThere = [&](const Point2& place) { return isNear(place, point, kSameThing); };
    if (std::any_of(places.begin(), places.end(), isThere)) {
      points->push_back(view_.toBase(point));
      if (is_near != nullptr) (*is_near)[i] = 1;
    }
  }
  for (const Point2& place : places) {
    if (sightOf(place, view_) == Sight::kUnknown) {
      points->push_back(view_.toBase(place));
    }
  }
}

}  // namespace lstm_planner
