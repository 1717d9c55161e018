#include "lstm_planner/drive/motion/path_tracker.hpp"

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

MotionCommand PathTracker::compute(const std::vector<Pose2>& plan, const Situation& situation, const Twist2& twist,
                                   const Shield& shield, double period) {
  if (!(period >= kShortestPeriod)) return {{}, StopReason::kUnusableData};
  moving_.show(situation);
  if (!shield.footprint().isCircle()) lookBack(plan, situation, shield);
  const MotionSituation motion{plan, situation.pose, twist, shield, period};
  MotionCommand command = controller_.compute(motion, moving_.points(), moving_.resting(), history_);
  if (controller_.parameters().evade_time > 0.0) {
    const MotionParameters& limits = controller_.parameters();
    const double free_behind =
        seenFreeBehind(situation, shield.footprint(), limits.safety_margin, limits.max_linear * limits.evade_time);
    command = controller_.evade(command, motion, moving_.follow(situation), free_behind, history_);
  }
  const Patience::Left left = patience_.note(controller_.parameters().patience, command, plan, situation);
  if (left == Patience::Left::kNone) command = {{}, StopReason::kStuck};
  history_.has_stood = left != Patience::Left::kMuch;
  history_.goes_back = command.goes_back;
  if (!command.goes_back) way_out_.clear();
  history_.note(command, controller_.reactionTime(), period);
  reaction_.note(twist.angular, command.angular, period, controller_.parameters().reaction_time);
  return command;
}

void PathTracker::lookBack(const std::vector<Pose2>& plan, const Situation& situation, const Shield& shield) {
  const Pose2& pose = situation.pose;
  trail_.note(pose, history_.goes_back && !history_.gets_out);
  if (history_.has_stood && !wedged_at_) wedged_at_ = pose;
  if (wedged_at_ && distanceBetween(*wedged_at_, pose) > kAway) wedged_at_.reset();
  if (wedged_at_ && way_out_.isEmpty()) planWayOut(plan, situation, shield);
  way_out_.note(pose, true);
  history_.back = way_out_.back(pose, true);
  history_.gets_out = history_.back.has_value();
  if (history_.gets_out) return;
  if (way_out_.endsAt(pose)) wedged_at_.reset();
  way_out_.clear();
  history_.back = trail_.back(pose, history_.goes_back);
}

void PathTracker::planWayOut(const std::vector<Pose2>& plan, const Situation& situation, const Shield& shield) {
  if (std::abs(situation.time - planned_at_) < kPlansEvery) return;
  planned_at_ = situation.time;
  const Pose2& pose = situation.pose;
  const std::vector<Pose2> was = trail_.seenFrom(pose);
  const std::vector<Pose2> start = startOf(plan, pose);
  for (const double share : kMargins) {
    const std::vector<Pose2> way = findWayOut(shield, share * controller_.parameters().safety_margin, was, start);
    for (auto place = way.rbegin(); place != way.rend(); ++place) way_out_.note(compose(pose, *place), false);
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
  history_ = {};
}

}  // namespace lstm_planner
