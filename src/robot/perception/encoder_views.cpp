#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lstm_planner/robot/perception/encoder.hpp"

namespace lstm_planner {
namespace {

/// A sector is half as wide as views lie apart, and the scanner looks into eight of the sixteen around.
constexpr int kSectorsAView = 2;
constexpr int kSectorsAround = kSectorsAView * kDriveViews;

constexpr double kDiagonal = 0.70710678118654752;

/// Of length 1, relative to the heading.
constexpr std::array<Point2, kDriveViews> kViewDirections = {{{1.0, 0.0},
                                                              {kDiagonal, kDiagonal},
                                                              {0.0, 1.0},
                                                              {-kDiagonal, kDiagonal},
                                                              {-1.0, 0.0},
                                                              {-kDiagonal, -kDiagonal},
                                                              {0.0, -1.0},
                                                              {kDiagonal, -kDiagonal}}};

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
  bearings.goal_direction = {std::cos(bearings.goal), std::sin(bearings.goal)};
  bearings.previous_direction = {std::cos(bearings.previous_action), std::sin(bearings.previous_action)};
  return bearings;
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

double Encoder::valueOfBearing(Feature feature, const ViewBearings& bearings, int view) const {
  const Point2 ahead = kViewDirections[static_cast<std::size_t>(view)];
  const auto along = [&](const Point2& direction) { return ahead.x * direction.x + ahead.y * direction.y; };
  const auto aside = [&](const Point2& direction) { return ahead.x * direction.y - ahead.y * direction.x; };
  const double angle = view * kViewAngle;
  switch (feature) {
    case Feature::kGoalBearing:
      return normalizeAngle(bearings.goal - angle) / parameters_->angle_scale;
    case Feature::kGoalBearingSin:
      return aside(bearings.goal_direction);
    case Feature::kGoalBearingCos:
      return along(bearings.goal_direction);
    case Feature::kHeading:
      return normalizeAngle(-angle) / parameters_->angle_scale;
    case Feature::kHeadingSin:
      return -ahead.y;
    case Feature::kHeadingCos:
      return ahead.x;
    case Feature::kPreviousAction:
      return normalizeAngle(bearings.previous_action - angle) / parameters_->action_scale;
    case Feature::kPreviousActionSin:
      return aside(bearings.previous_direction);
    case Feature::kPreviousActionCos:
      return along(bearings.previous_direction);
    case Feature::kMotionForward:
      return std::clamp(along(bearings.motion), -1.0, 1.0);
    case Feature::kMotionLeft:
      return std::clamp(aside(bearings.motion), -1.0, 1.0);
    default:
      return 0.0;
  }
}

void Encoder::turn(const float* ahead, const ViewBearings& bearings, int view, float* input, int stride) const {
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
        *input = static_cast<float>(valueOfBearing(feature.feature, bearings, view));
        break;
    }
    ++source;
    input += stride;
  }
}

}  // namespace lstm_planner
