#include "lstm_planner/drive/motion/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/drive/decision/arrival.hpp"

namespace lstm_planner {

namespace {

/// Makes a plan of straight pieces, all poses looking along it.
class PlanLine {
 public:
  /// Goes on from the plan's last pose.
  PlanLine(double spacing, std::vector<Pose2>* plan) : spacing_(spacing), plan_(*plan) {}

  /// Appends poses from the end of the plan to `end`; as soon as there are too many, keeps it for finish().
  void lineTo(const Point2& end) {
    if (!beyond_.empty()) {
      beyond_.push_back(end);
      return;
    }
    const Pose2 start = plan_.back();
    const double length = distanceBetween(start, end);
    if (length <= 0.0) {
      return;
    }
    const double direction = directionTo(start, end);
    const double poses = std::max(1.0, std::ceil(length / spacing_));
    const Point2 step{(end.x - start.x) / poses, (end.y - start.y) / poses};
    const std::size_t first = plan_.size();
    const std::size_t room = kMostDensePlanPoses - std::min(kMostDensePlanPoses, first);
    const bool fits = poses <= static_cast<double>(room);
    const std::size_t count = fits ? static_cast<std::size_t>(poses) : room;
    plan_.resize(first + count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto steps = static_cast<double>(i + 1);
      plan_[first + i] = {start.x + steps * step.x, start.y + steps * step.y, direction};
    }
    if (fits) {
      plan_.back() = {end.x, end.y, direction};
    } else {
      beyond_.push_back(end);
    }
  }

  /// Appends the rest, which cuts corners where it must be coarse.
  void finish() {
    double length = 0.0;
    Point2 from{plan_.back().x, plan_.back().y};
    for (const Point2& corner : beyond_) {
      length += distanceBetween(from, corner);
      from = corner;
    }
    const auto room = static_cast<double>(kMostPlanPoses - plan_.size());
    const double gap = length / std::min(room, std::ceil(length / spacing_));
    from = {plan_.back().x, plan_.back().y};
    double before = 0.0;  // m from `from` back to the last pose
    for (const Point2& corner : beyond_) {
      const double piece = distanceBetween(from, corner);
      double along = gap - before;
      for (; along < piece && plan_.size() + 1 < kMostPlanPoses; along += gap) {
        append({from.x + along / piece * (corner.x - from.x), from.y + along / piece * (corner.y - from.y)});
      }
      before = piece - (along - gap);
      from = corner;
    }
    if (!beyond_.empty()) append(beyond_.back());
  }

 private:
  void append(const Point2& place) { plan_.push_back({place.x, place.y, directionTo(plan_.back(), place)}); }

  double spacing_;
  std::vector<Pose2>& plan_;
  std::vector<Point2> beyond_;  ///< where the pieces end for which there were too many poses
};

/// The steps beyond the waypoint, each the free one that leads most towards the goal. In the base frame.
class StepsTowards {
 public:
  StepsTowards(const Point2& goal, const Shield& shield, const AgentParameters& agent)
      : goal_(goal), shield_(shield), clearance_(agent.shield.clearance), length_(agent.step.length) {}

  /// Goes on from `at`, where the last step was headed in `direction`, by `most` steps or fewer, all in one direction.
  /// Returns how many; 0 where there is none, or from where the path to the goal would have to be guessed.
  int go(int most, Point2* at, double* direction) const {
    const double left = distanceBetween(*at, goal_);
    const double length = std::min(length_, left);
    const double bearing = directionTo(*at, goal_);
    const double straight = std::min(left, most * length_);
    const double free = shield_.freeDistance(*at, bearing, straight, clearance_);
    if (free >= length) {
      const int steps = free >= straight ? most : static_cast<int>(free / length_);
      *direction = bearing;
      *at = pointAlong(*at, bearing, std::min(left, steps * length_));
      return steps;
    }
    const std::optional<double> aside = directionAside(*at, bearing, *direction, length);
    if (!aside) return 0;
    const Point2 next = pointAlong(*at, *aside, length);
    if (distanceBetween(next, goal_) > left) return 0;
    *direction = *aside;
    *at = next;
    return 1;
  }

 private:
  /// The free steering angle nearest to the bearing, of two as far aside the first one.
  std::optional<double> directionAside(const Point2& at, double bearing, double heading, double length) const {
    static const ActionSet actions;
    double nearest = M_PI;
    std::optional<double> free;
    for (const double angle : actions.angles()) {
      const double direction = heading + angle;
      const double aside = std::abs(normalizeAngle(direction - bearing));
      if (aside >= nearest || !shield_.isFree(at, direction, length, clearance_)) continue;
      nearest = aside;
      free = direction;
    }
    return free;
  }

  Point2 goal_;
  const Shield& shield_;
  double clearance_;  ///< m
  double length_;     ///< m
};

}  // namespace

void rollOut(const Situation& situation, const Decision& decision, const Shield& shield, const Pose2& goal,
             const AgentParameters& agent, const RolloutParameters& parameters, std::vector<Pose2>* plan) {
  plan->clear();
  plan->push_back(situation.pose);
  PlanLine line(parameters.spacing, plan);
  if (decision.choice != Decision::Move::kArrived) {
    line.lineTo(decision.waypoint);
    for (const Point2& corner : decision.path_on) {
      line.lineTo(corner);
    }
    const Point2 local_goal = toLocalFrame(situation.pose, decision.destination);
    Point2 at = toLocalFrame(situation.pose, decision.waypoint);
    double direction = decision.direction - situation.pose.yaw;
    if (isOneStep(decision) && decision.path_on.empty() && distanceBetween(at, local_goal) > agent.step.length) {
      // Straight on for another step: a controller that looks ahead of the waypoint must not turn for the goal before
      // the leader has decided to.
      at = pointAlong(at, direction, shield.freeDistance(at, direction, agent.step.length, agent.shield.clearance));
      line.lineTo(toParentFrame(situation.pose, at));
    }
    const bool moves = decision.path_on.empty() && decision.choice != Decision::Move::kLookAround;
    const StepsTowards steps(local_goal, shield, agent);
    for (int left = moves ? parameters.steps : 0; left > 0 && distanceBetween(at, local_goal) > agent.goal_tolerance;) {
      const int made = steps.go(left, &at, &direction);
      if (made == 0) break;
      left -= made;
      line.lineTo(toParentFrame(situation.pose, at));
    }
  }
  line.lineTo(decision.destination);
  const Point2 end = endOfPlan(decision, {goal.x, goal.y}, agent);
  line.lineTo(end);
  line.finish();
  const Pose2 last{end.x, end.y, goal.yaw};
  if (plan->size() == 1) {
    plan->push_back(last);
  }
  plan->back() = last;
}

}  // namespace lstm_planner
