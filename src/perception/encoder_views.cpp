#include <cmath>

#include "lstm_planner/perception/encoder.hpp"
#include "view_bearings.hpp"

namespace lstm_planner {
namespace {

/// A sector is half as wide as views lie apart, and the scanner looks into eight of the sixteen around.
constexpr int kSectorsAView = 2;
constexpr int kSectorsAround = kSectorsAView * kDriveViews;

}  // namespace

int viewNearest(double angle) {
  return static_cast<int>(std::lround(normalizeAngle(angle) / kViewAngle)) & (kDriveViews - 1);
}

ViewBearings bearingsOf(const Observation& observation) {
  ViewBearings bearings;
  bearings.ahead = viewNearest(observation.heading);
  bearings.goal = observation.goal_bearing;
  bearings.previous_action = normalizeAngle(observation.previous_action - observation.turn);
  bearings.motion = toLocalFrame({0.0, 0.0, observation.turn}, observation.motion);
  return bearings;
}

void turnBearings(const ViewBearings& bearings, double angle, Observation* observation) {
  observation->goal_bearing = bearings.goal - angle;
  observation->heading = -angle;
  observation->previous_action = bearings.previous_action - angle;
  observation->motion = toLocalFrame({0.0, 0.0, angle}, bearings.motion);
}

Encoder::Source Encoder::sourceOf(const Input& input, int view) const {
  int index = input.index;
  switch (input.feature) {
    case Feature::kGoalBearing:
    case Feature::kGoalBearingSin:
    case Feature::kGoalBearingCos:
    case Feature::kHeading:
    case Feature::kHeadingSin:
    case Feature::kHeadingCos:
    case Feature::kPreviousAction:
    case Feature::kPreviousActionSin:
    case Feature::kPreviousActionCos:
    case Feature::kMotionForward:
    case Feature::kMotionLeft:
      return {Source::Kind::kBearing, 0};
    case Feature::kSector:
    case Feature::kEvent:
    case Feature::kSeen:
      index = (index + kSectorsAView * view) % kSectorsAround;
      if (index >= kSectorCount) return {Source::Kind::kNothing, 0};
      break;
    case Feature::kVisits:
    case Feature::kPlaceVisits:
    case Feature::kPlaceFreshness:
      index = (index + view) % kPlaceDirections;
      break;
    default:
      break;
  }
  std::uint8_t source = 0;
  for (const Input& other : features_) {
    if (other.feature == input.feature && other.index == index && other.scale == input.scale) break;
    ++source;
  }
  return {Source::Kind::kAhead, source};
}

void Encoder::findSources() {
  sources_.reserve(kDriveViews * features_.size());
  for (int view = 0; view < kDriveViews; ++view) {
    for (const Input& input : features_) sources_.push_back(sourceOf(input, view));
  }
}

void Encoder::turn(const float* ahead, const ViewBearings& bearings, int view, float* input, int stride) const {
  Observation turned;
  turnBearings(bearings, view * kViewAngle, &turned);
  const Source* source = &sources_.at(static_cast<std::size_t>(view) * features_.size());
  for (const Input& feature : features_) {
    switch (source->kind) {
      case Source::Kind::kAhead:
        *input = ahead[source->index];
        break;
      case Source::Kind::kNothing:
        *input = 0.0f;
        break;
      case Source::Kind::kBearing:
        *input = static_cast<float>(value(feature, turned));
        break;
    }
    ++source;
    input += stride;
  }
}

}  // namespace lstm_planner
