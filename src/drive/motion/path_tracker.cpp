#include "lstm_planner/drive/motion/path_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "drive/motion/motion_parts.hpp"
#include "drive/motion/way_out.hpp"
#include "drive/perception/seen_free.hpp"

namespace lstm_planner {

namespace {

constexpr double kPlansEvery = 0.2;    // s; a way out that turned out not to be safe is planned anew from where it led
constexpr double kAway = 2.0;          // m from where the robot was wedged in
constexpr double kPlannedAlong = 3.0;  // m of the plan that a way out leads to

/// Shares of the safety margin that a way out keeps, the widest that there is first. More than is kept while it is
/// driven (kLeastMargin): the robot does not drive it exactly.
constexpr double kMargins[] = {1.0, kNarrowMargin};

/// The first metres of a plan as seen from a pose.
std::vector<Pose2> startOf(const std::vector<Pose2>& plan, const Pose2& pose) {
  std::vector<Pose2> start;
  for (const Pose2& place : plan) {
    if (!start.empty() && distanceBetween(place, pose) > kPlannedAlong) break;
    start.push_back(compose(inverse(pose), place));
  }
  return start;
}

}  // namespace

MotionCommand PathTracker::compute(const MotionSituation& now, const Situation& seen, double later) {
  if (!(now.period >= kShortestPeriod)) return {{}, StopReason::kUnusableData};
  moving_.show(seen);
  if (!now.shield.footprint().isCircle()) lookBack(now, seen.time);
  // Of a robot that has not moved nothing is rounded.
  const bool has_moved = distanceBetween(now.pose, seen.pose) > 0.0 || now.pose.yaw != seen.pose.yaw;
  const Pose2 then = has_moved ? compose(inverse(now.pose), seen.pose) : Pose2();
  MotionCommand command =
      controller_.compute(now, toParentFrame(then, moving_.points()), toParentFrame(then, moving_.resting()), history_);
  const MotionParameters& limits = controller_.parameters();
  if (limits.evade_time > 0.0) {
    const double most = limits.max_linear * limits.evade_time;
    const double was_free = seenFreeBehind(seen, now.shield.footprint(), limits.safety_margin, most);
    const double free_behind = std::max(0.0, was_free - std::hypot(then.x, then.y));
    command = controller_.evade(command, now, moving_.follow(seen, now.pose, later), free_behind, history_);
  }
  const Patience::Left left = patience_.note(limits.patience, command, now.plan, seen);
  if (left == Patience::Left::kNone) command = {{}, StopReason::kStuck};
  history_.has_stood = left != Patience::Left::kMuch;
  history_.goes_back = command.goes_back;
  if (!command.goes_back) way_out_.clear();
  history_.note(command, controller_.reactionTime(), now.period);
  reaction_.note(now.current.angular, command.angular, now.period, limits.reaction_time);
  shortfall_.note(now.current.linear, command.linear, now.period, limits.linear_acceleration * now.period);
  history_.short_by = shortfall_.shortBy();
  return command;
}

void PathTracker::lookBack(const MotionSituation& now, double time) {
  trail_.note(now.pose, history_.goes_back && !history_.gets_out);
  if (history_.has_stood && !wedged_at_) wedged_at_ = now.pose;
  if (wedged_at_ && distanceBetween(*wedged_at_, now.pose) > kAway) wedged_at_.reset();
  if (wedged_at_ && way_out_.isEmpty()) planWayOut(now, time);
  way_out_.note(now.pose, true);
  history_.back = way_out_.back(now.pose, true);
  history_.gets_out = history_.back.has_value();
  if (history_.gets_out) return;
  if (way_out_.endsAt(now.pose)) wedged_at_.reset();
  way_out_.clear();
  history_.back = trail_.back(now.pose, history_.goes_back);
}

void PathTracker::planWayOut(const MotionSituation& now, double time) {
  if (std::abs(time - planned_at_) < kPlansEvery) return;
  planned_at_ = time;
  const std::vector<Pose2> was = trail_.seenFrom(now.pose);
  const std::vector<Pose2> start = startOf(now.plan, now.pose);
  for (const double share : kMargins) {
    const std::vector<Pose2> way = findWayOut(now.shield, share * controller_.parameters().safety_margin, was, start);
    for (auto place = way.rbegin(); place != way.rend(); ++place) way_out_.note(compose(now.pose, *place), false);
    if (!way.empty()) return;
  }
}

void PathTracker::forget() {
  moving_.reset();
  trail_.clear();
  way_out_.clear();
  wedged_at_.reset();
  patience_.clear();
  reaction_.forget();
  shortfall_ = {};
  history_ = {};
}

}  // namespace lstm_planner
