#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "lstm_planner/drive/perception/encoder.hpp"

namespace lstm_planner {
namespace {

/// A sector is half as wide as views lie apart.
constexpr int kSectorsAView = 2;

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

/// Values around the robot, an eighth of a turn apart; twice, so that they can be copied from any on.
class Ring {
 public:
  void set(std::size_t i, float value) { values_[i] = values_[i + kDriveViews] = value; }
  void copyFrom(int first, float* to) const {
    const auto from = static_cast<std::size_t>(first & (kDriveViews - 1));
    std::memcpy(to, &values_[from], kDriveViews * sizeof(float));
  }

 private:
  std::array<float, 2 * kDriveViews> values_;
};

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

/// A value for each view, by the number of eighths of a turn that it is turned.
template <typename Value>
void Encoder::fillViews(const ViewBearings& bearings, const Value& value, float* row) {
  Ring ring;
  for (std::size_t view = 0; view < kDriveViews; ++view) ring.set(view, static_cast<float>(value(view)));
  ring.copyFrom(-bearings.ahead, row);
}

/// False for features that do not turn.
bool Encoder::fillBearings(Feature feature, const ViewBearings& bearings, float* row) const {
  const auto angles = [&](double bearing, double scale) {
    const auto value = [=](std::size_t view) {
      return normalizeAngle(bearing - static_cast<double>(view) * kViewAngle) / scale;
    };
    fillViews(bearings, value, row);
  };
  const auto along = [&](const Point2& direction) {
    const auto value = [=](std::size_t view) {
      return kViewDirections[view].x * direction.x + kViewDirections[view].y * direction.y;
    };
    fillViews(bearings, value, row);
  };
  const auto aside = [&](const Point2& direction) {
    const auto value = [=](std::size_t view) {
      return kViewDirections[view].x * direction.y - kViewDirections[view].y * direction.x;
    };
    fillViews(bearings, value, row);
  };
  const auto clamp = [&] {
    for (int view = 0; view < kDriveViews; ++view) row[view] = std::clamp(row[view], -1.0f, 1.0f);
  };
  switch (feature) {
    case Feature::kGoalBearing:
      angles(bearings.goal, parameters_->angle_scale);
      return true;
    case Feature::kGoalBearingSin:
      aside(bearings.goal_direction);
      return true;
    case Feature::kGoalBearingCos:
      along(bearings.goal_direction);
      return true;
    case Feature::kHeading:
      angles(0.0, parameters_->angle_scale);
      return true;
    case Feature::kHeadingSin:
      aside({1.0, 0.0});
      return true;
    case Feature::kHeadingCos:
      along({1.0, 0.0});
      return true;
    case Feature::kPreviousAction:
      angles(bearings.previous_action, parameters_->action_scale);
      return true;
    case Feature::kPreviousActionSin:
      aside(bearings.previous_direction);
      return true;
    case Feature::kPreviousActionCos:
      along(bearings.previous_direction);
      return true;
    case Feature::kMotionForward:
      along(bearings.motion);
      clamp();
      return true;
    case Feature::kMotionLeft:
      aside(bearings.motion);
      clamp();
      return true;
    default:
      return false;
  }
}

/// What the view ahead sees, for each view.
void Encoder::spread(const Group& group, const float* ahead, int direction, float* inputs, int stride) {
  const auto rowOf = [&](std::size_t i) { return inputs + group.at[i] * stride; };
  switch (group.feature) {
    case Feature::kSector:
    case Feature::kEvent:
    case Feature::kSeen: {
      // The scanner sees half of the directions. Every second sector lies a view on.
      Ring even{};
      Ring odd{};
      for (std::size_t i = 0; i < kSectorCount; i += kSectorsAView) {
        even.set(i / kSectorsAView, ahead[group.at[i]]);
        odd.set(i / kSectorsAView, ahead[group.at[i + 1]]);
      }
      for (std::size_t i = 0; i < kSectorCount; ++i) {
        (i % kSectorsAView == 0 ? even : odd).copyFrom(static_cast<int>(i) / kSectorsAView - direction, rowOf(i));
      }
      break;
    }
    case Feature::kVisits:
    case Feature::kPlaceVisits:
    case Feature::kPlaceFreshness: {
      Ring around{};
      for (std::size_t i = 0; i < kDriveViews; ++i) around.set(i, ahead[group.at[i]]);
      for (std::size_t i = 0; i < kDriveViews; ++i) around.copyFrom(static_cast<int>(i) - direction, rowOf(i));
      break;
    }
    default:
      std::fill_n(rowOf(0), kDriveViews, ahead[group.at[0]]);
  }
}

void Encoder::turn(const float* ahead, const ViewBearings& bearings, float* inputs, int stride) const {
  for (const Group& group : groups_) {
    if (fillBearings(group.feature, bearings, inputs + group.at[0] * stride)) continue;
    spread(group, ahead, bearings.ahead, inputs, stride);
  }
}

void Encoder::encodeViews(const Observation& observation, const ViewBearings& bearings, float* ahead, float* inputs,
                          int stride) const {
  for (const Group& group : groups_) {
    if (fillBearings(group.feature, bearings, inputs + group.at[0] * stride)) continue;
    fill(group, observation, ahead);
    spread(group, ahead, bearings.ahead, inputs, stride);
  }
}

}  // namespace lstm_planner
