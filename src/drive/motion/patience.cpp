#include "lstm_planner/drive/motion/patience.hpp"

#include <cmath>

#include "drive/motion/motion_parts.hpp"

namespace lstm_planner {

namespace {

constexpr double kGivesUpFor = 3.0;  // times the limit
constexpr double kWayAhead = 0.3;    // m along the plan to where it leads
constexpr double kAnotherWay = 1.0;  // rad
constexpr int kMostRetries = 4;      // until the robot gets away
constexpr double kPause = 2.0;       // s without a question, in which nobody expected it to get away

}  // namespace

Patience::Left Patience::note(double limit, const MotionCommand& command, const std::vector<Pose2>& plan,
                              const Situation& situation) {
  if (plan.empty()) {
    clear();
    return Left::kMuch;
  }
  // Between two drives, or while scans were missing. But who gave up has still given up after a recovery.
  if (!gave_up_towards_ && situation.time - asked_ > kPause) stand_.excuse(situation.time);
  asked_ = situation.time;
  stand_.note(situation.pose, situation.time, {plan.back().x, plan.back().y},
              command.linear != 0.0 || command.angular != 0.0);
  const bool is_excused = command.stop == StopReason::kPerson || command.stop == StopReason::kArrived;
  if (is_excused) stand_.excuse(situation.time);
  const Left left = limit > 0.0 && stand_.stood() > 0.5 * limit ? Left::kLessThanHalf : Left::kMuch;
  const bool is_stuck = (command.stop == StopReason::kObstacle ? stand_.stood() : stand_.tried()) > limit;
  if (limit == 0.0 || !is_stuck) {
    gave_up_towards_.reset();
    // Back through places where it has just been it does get away.
    if (left == Left::kLessThanHalf && command.goes_back && stand_.retries() < kMostRetries) stand_.retry();
    return left;
  }
  // Whoever hears of it has given up by then, or expects another try.
  if (stand_.stood() > kGivesUpFor * limit) stand_.clear();
  if (!leadsAnotherWay(plan, situation.pose) || stand_.retries() >= kMostRetries) return Left::kNone;
  stand_.retry();
  return left;
}

/// Than the plan did with which the robot gave up here.
bool Patience::leadsAnotherWay(const std::vector<Pose2>& plan, const Pose2& pose) {
  const double direction = directionTo(pose, firstBeyond(plan.begin(), plan, pose, kWayAhead));
  if (!gave_up_towards_) gave_up_towards_ = direction;
  return std::abs(normalizeAngle(direction - *gave_up_towards_)) > kAnotherWay;
}

void Patience::clear() {
  stand_.clear();
  gave_up_towards_.reset();
}

}  // namespace lstm_planner
