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

/// What the view ahead sees, for each view: `at` are the rows of a group's inputs, `ahead` is the view ahead.
void spread(InputTurns turns, const std::array<std::int16_t, kDriveViews>& at, const float* ahead, int direction,
            float* inputs, int stride) {
  const auto rowOf = [&](std::size_t i) { return inputs + at[i] * stride; };
  if (turns == InputTurns::kWithScanner) {
    // The scanner sees half of the directions. Every second sector lies a view on.
    Ring even{};
    Ring odd{};
    for (std::size_t i = 0; i < kSectorCount; i += kSectorsAView) {
      even.set(i / kSectorsAView, ahead[at[i]]);
      odd.set(i / kSectorsAView, ahead[at[i + 1]]);
    }
    for (std::size_t i = 0; i < kSectorCount; ++i) {
      (i % kSectorsAView == 0 ? even : odd).copyFrom(static_cast<int>(i) / kSectorsAView - direction, rowOf(i));
    }
  } else if (turns == InputTurns::kAround) {
    Ring around{};
    for (std::size_t i = 0; i < kDriveViews; ++i) around.set(i, ahead[at[i]]);
    for (std::size_t i = 0; i < kDriveViews; ++i) around.copyFrom(static_cast<int>(i) - direction, rowOf(i));
  } else {
    std::fill_n(rowOf(0), kDriveViews, ahead[at[0]]);
  }
}

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

/// A value for each view.
void Encoder::fillViews(const Group& group, const ViewBearings& bearings, float* row) const {
  Ring ring;
  for (int view = 0; view < kDriveViews; ++view) {
    ring.set(static_cast<std::size_t>(view), static_cast<float>(group.input->from(bearings, *parameters_, view)));
  }
  ring.copyFrom(-bearings.ahead, row);
}

void Encoder::turn(const float* ahead, const ViewBearings& bearings, float* inputs, int stride) const {
  for (const Group& group : groups_) {
    if (group.input->turns == InputTurns::kBearing) {
      fillViews(group, bearings, inputs + group.at[0] * stride);
    } else {
      spread(group.input->turns, group.at, ahead, bearings.ahead, inputs, stride);
    }
  }
}

void Encoder::encodeViews(const Observation& observation, const ViewBearings& bearings, float* ahead, float* inputs,
                          int stride) const {
  for (const Group& group : groups_) {
    if (group.input->turns != InputTurns::kBearing) fill(group, observation, ahead);
  }
  turn(ahead, bearings, inputs, stride);
}

}  // namespace lstm_planner
