#include "lstm_planner/drive/local_map/full_turn.hpp"

#include <algorithm>

namespace lstm_planner {

namespace {

constexpr double kEnough = kFullTurn - 0.5;  // rad; the scanner sees more than the rest at once
constexpr double kProgress = 0.2;            // rad
constexpr double kPatience = 5.0;            // s for that progress

}  // namespace

void FullTurn::start(double yaw, double time) {
  *this = {};
  yaw_ = yaw;
  since_ = now_ = time;
}

void FullTurn::note(double yaw, double time) {
  turn_ += normalizeAngle(yaw - yaw_);
  yaw_ = yaw;
  now_ = time;
  least_ = std::min(least_, turn_);
  most_ = std::max(most_, turn_);
  if (most_ - least_ < noted_ + kProgress) return;
  noted_ = most_ - least_;
  since_ = time;
}

bool FullTurn::isOver() const { return most_ - least_ >= kEnough || now_ - since_ > kPatience; }

}  // namespace lstm_planner
