#include "lstm_planner/drive/perception/moving_things.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lstm_planner {

namespace {

constexpr double kNeighbours = 0.25;    // m between returns of one thing
constexpr double kLargestThing = 1.5;   // m; more than that is a wall with something before it
constexpr std::size_t kFewest = 3;      // returns that move
constexpr double kMemory = 0.5;         // s, over which the velocity is measured
constexpr double kShortestLook = 0.15;  // s; over less it is noise
constexpr double kOutOfSight = 1.5;     // s, for which a thing is taken to go on
constexpr double kGate = 0.4;           // m between where a thing is expected and where it is
constexpr double kFastest = 3.0;        // m/s of a thing whose velocity is not known yet
constexpr double kShrink = 0.9;         // of the radius in a scan: a part may be hidden

}  // namespace

Point2 MovingThings::Track::at(double time) const {
  const Sighting& last = sightings.back();
  const double since = time - last.time;
  return {last.middle.x + since * velocity.x, last.middle.y + since * velocity.y};
}

void MovingThings::show(const std::vector<Point2>& returns, const std::vector<std::uint8_t>& moves, double time) {
  if (!std::isfinite(time)) return reset();
  if (time < time_) reset();
  time_ = time;
  findBodies(returns, moves);
  std::vector<std::uint8_t> is_taken(tracks_.size(), 0);
  for (const Body& body : bodies_) extend(body, &tracks_[trackOf(body, &is_taken)]);
  const auto isGone = [&](const Track& track) { return time - track.sightings.back().time > kOutOfSight; };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), isGone), tracks_.end());
}

std::vector<MovingThing> MovingThings::around(const Pose2& pose) const {
  std::vector<MovingThing> things;
  for (const Track& track : tracks_) {
    if (!track.is_measured) continue;
    things.push_back(
        {toLocalFrame(pose, track.at(time_)), track.radius, toLocalFrame({0.0, 0.0, pose.yaw}, track.velocity)});
  }
  return things;
}

void MovingThings::findBodies(const std::vector<Point2>& returns, const std::vector<std::uint8_t>& moves) {
  bodies_.clear();
  std::size_t first = 0;
  for (std::size_t end = 1; end <= returns.size(); ++end) {
    if (end < returns.size() && distanceBetween(returns[end - 1], returns[end]) <= kNeighbours) continue;
    addBody(returns, moves, first, end);
    first = end;
  }
}

void MovingThings::addBody(const std::vector<Point2>& returns, const std::vector<std::uint8_t>& moves,
                           std::size_t first, std::size_t end) {
  std::size_t moving = 0;
  for (std::size_t i = first; i < end; ++i) moving += moves[i];
  if (moving < kFewest) return;
  if (distanceBetween(returns[first], returns[end - 1]) > kLargestThing) {
    while (moves[first] == 0) ++first;
    while (moves[end - 1] == 0) --end;
  }
  const Point2& left = returns[first];
  const Point2& right = returns[end - 1];
  bodies_.push_back({{0.5 * (left.x + right.x), 0.5 * (left.y + right.y)}, 0.5 * distanceBetween(left, right)});
}

std::size_t MovingThings::trackOf(const Body& body, std::vector<std::uint8_t>* is_taken) {
  std::size_t best = tracks_.size();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < is_taken->size(); ++i) {
    const Track& track = tracks_[i];
    const double since = time_ - track.sightings.back().time;
    const double gate = track.is_measured ? kGate : kGate + kFastest * since;
    const double distance = distanceBetween(track.at(time_), body.middle);
    if ((*is_taken)[i] == 0 && distance < std::min(gate, nearest)) {
      best = i;
      nearest = distance;
    }
  }
  if (best == tracks_.size()) {
    tracks_.emplace_back();
  } else {
    (*is_taken)[best] = 1;
  }
  return best;
}

void MovingThings::extend(const Body& body, Track* track) const {
  track->sightings.push_back({body.middle, time_});
  track->radius = std::max(body.radius, kShrink * track->radius);
  while (time_ - track->sightings.front().time > kMemory) track->sightings.pop_front();
  if (time_ - track->sightings.front().time >= kShortestLook) measure(track);
}

void MovingThings::measure(Track* track) {
  const auto count = static_cast<double>(track->sightings.size());
  Sighting mean{{0.0, 0.0}, 0.0};
  for (const Sighting& sighting : track->sightings) {
    mean.time += sighting.time / count;
    mean.middle.x += sighting.middle.x / count;
    mean.middle.y += sighting.middle.y / count;
  }
  double spread = 0.0;
  Point2 slope;
  for (const Sighting& sighting : track->sightings) {
    const double since = sighting.time - mean.time;
    spread += since * since;
    slope.x += since * (sighting.middle.x - mean.middle.x);
    slope.y += since * (sighting.middle.y - mean.middle.y);
  }
  track->velocity = {slope.x / spread, slope.y / spread};
  track->is_measured = true;
}

}  // namespace lstm_planner
