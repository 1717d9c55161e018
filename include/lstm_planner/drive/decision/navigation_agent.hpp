#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/detour_bound.hpp"
#include "lstm_planner/common/progress_watch.hpp"
#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/drive/decision/arrival.hpp"
#include "lstm_planner/drive/decision/bug_algorithm.hpp"
#include "lstm_planner/drive/decision/decision.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/drive/decision/drive_trace.hpp"
#include "lstm_planner/drive/decision/step_clock.hpp"
#include "lstm_planner/drive/local_map/replanner.hpp"
#include "lstm_planner/drive/perception/out_of_view.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

struct StepContext;

/// Decides, step by step, where the robot goes: network -> shield -> bound.
///
/// The inputs of the network are what the robot senses and where it has been; its answer is a preference over five
/// steering angles. The shield takes those away that would hit something. The path through the remembered obstacles
/// (Replanner) tells what the preferred one of the others costs more than the best: it is carried out while the sum of
/// these detours stays within a bound (DetourBound), otherwise that path decides the step. If the path leaves in the
/// direction of the preferred angle, the waypoint lies on the path. Where the remembered obstacles were wrong too
/// often, the last resort is boundary following (BugAlgorithm).
///
/// With AgentParameters::leader the path, or only the goal's bearing, leads instead of the network.
///
/// Where nothing is remembered (memory/enabled is false), nothing limits detours, and boundary following leads when the
/// robot makes no progress. Without that, too (escape/enabled is false), a network that makes no progress draws its
/// steps (AgentParameters::draw_after).
///
/// The hidden state advances once a step (StepClock) and at no other time: asking twice gives the same answer. Not
/// thread safe. All poses and goals are in one frame, in which the robot moves without jumps: the odometry frame, or
/// one in which a localisation corrects it a little at a time.
class NavigationAgent {
 public:
  /// Throws std::invalid_argument for bad parameters, or a network that is to lead and does not fit them.
  NavigationAgent(DrivePolicy policy, const AgentParameters& parameters);

  /// Changes leader, goal_tolerance, goal_in_sight and the escape's patience, from the next decision on; all other
  /// parameters stay. Throws std::invalid_argument, and changes nothing, if a value cannot be used, or as the
  /// constructor.
  void change(const AgentParameters& parameters);

  /// What is seen, and from where (lstm_planner::perceive()): situation(). Throws std::invalid_argument when the pose
  /// is out of reach (checkPose).
  ///
  /// Where the scanner does not reach as far as the network needs, the path through what is remembered leads in its
  /// place. Some drivers send the largest reading as range_max, so the largest one so far counts. Throws
  /// std::invalid_argument if nothing is remembered (memory/enabled is false).
  void perceive(const Situation& situation);

  /// Obstacles of a costmap that the last scan does not show (costmapObstacles()); base frame, m. They count as
  /// returns, until the next scan: then they must be given again.
  void mark(const std::vector<Point2>& obstacles);

  /// Obstacles that are known before the drive, in the frame of the poses, m: they are remembered as if they had been
  /// seen, also after a jump, which does not move them. For comparison with a robot that knows the map.
  void know(std::vector<Point2> obstacles) {
    if (replanner_) replanner_->know(std::move(obstacles));
  }

  /// Decides in the situation that was perceived last: decision(). A new step if the last one is over or its path is
  /// blocked. Throws std::invalid_argument for a goal out of reach (checkGoal); GoalChanges refuses it before.
  const Decision& decide();

  /// What decide() would answer for a goal that has just been set. Does not change what decide() depends on. Throws
  /// std::invalid_argument for a goal out of reach (checkGoal).
  Decision preview(const Point2& goal) const;

  /// A new goal: forgets the hidden state, the step and the escape, but not what was seen on the way.
  void setGoal(const Point2& goal);

  /// The same goal has moved a little in the frame of the poses, because a localisation was corrected. Nothing is
  /// forgotten.
  void moveGoal(const Point2& goal);

  /// The odometry jumped, so remembered obstacles are in wrong places: forgets them, and all that setGoal() forgets.
  void restart();

  /// Called once a step with the network's inputs, after the network has advanced. If it returns an action that the
  /// shield allows, this action is taken instead of the network's own: so a teacher can steer.
  using StepListener = std::function<std::optional<int>(const Situation&, const Observation&)>;
  void setStepListener(StepListener listener) { step_listener_ = std::move(listener); }

  /// What was decided last.
  const Decision& decision() const { return decision_; }
  const Situation& situation() const { return situation_; }  ///< that was perceived last
  /// What left the field of view near a robot with corners, base frame, m (OutOfView); none of a round one.
  std::vector<Point2> outOfView() const { return out_of_view_ ? out_of_view_->points() : std::vector<Point2>(); }
  const Point2& goal() const { return goal_; }
  const Shield& shield() const { return shield_; }  ///< shows what was perceived, or decided about, last
  /// Places of the remembered obstacles, for drawing; empty if memory/enabled is false. Slow.
  std::vector<Point2> rememberedObstacles() const {
    return replanner_ ? replanner_->memory().obstacles() : std::vector<Point2>();
  }
  /// The remembered obstacles; null if memory/enabled is false.
  const LocalMap* memory() const { return replanner_ ? &replanner_->memory() : nullptr; }
  const AgentParameters& parameters() const { return parameters_; }
  const DrivePolicy& policy() const { return policy_; }
  /// m from the goal within which it counts as reached where it lies in or behind an obstacle (goal_drift).
  double reachedWithin() const { return toleranceAfter(driven_, parameters_); }
  /// Whether the path that was decided last ends beside the goal, which lies in or behind an obstacle.
  bool endsBesideGoal() const { return lstm_planner::endsBesideGoal(decision_, goal_, parameters_); }
  double bestDistance() const { return progress_.best(); }  ///< m to the goal, from where the robot was nearest to it
  /// Why the remembered path leads in place of the network that the parameters name; empty if it does not.
  std::string standInWarning() const;

 private:
  using Choice = Decision::Choice;
  using Move = Decision::Move;
  using Answer = Replanner::Answer;

  // A step.
  bool stepIsOver() const;
  bool pathIsFree();
  void tryAnotherWay();
  void noteProgress();
  void startFrom(const char* why);
  void losePatience();
  void arrive();
  bool isOutOfPatience(double times) const;
  Leader leaderBy(const AgentParameters& parameters) const;
  void choose(Leader leader, const char* why);
  void lead(Leader leader, const char* why);
  void startStep();
  void advanceNetwork(const Observation& observation);
  double previousAction() const;
  double drivenShare() const;

  // A decision.
  void decideStep();
  StepContext context();
  Decision::GoalSeems judgeGoal(Answer answer) const;
  bool chooseGoalInSight(const StepContext& step);
  void decideAsLed(const StepContext& step, Answer answer);

  DrivePolicy policy_;
  AgentParameters parameters_;
  Situation situation_;

  Leader chosen_;       ///< who is to lead: as the parameters say, or in place of a network that cannot
  double reach_ = 0.0;  ///< m, the largest range_max so far

  Point2 goal_;
  Decision decision_;
  Shield shield_;
  std::optional<OutOfView> out_of_view_;  ///< none of a circle: what it turns away from it does not hit
  BugAlgorithm bug_algorithm_;
  std::optional<Replanner> replanner_;  ///< none where nothing is to be remembered
  DetourBound bound_;
  DriveTrace trace_;
  StepClock clock_;
  std::optional<Point2> blocked_;  ///< place ahead, taken as blocked when the robot stalled; it has not moved since
  DrivenProgressWatch progress_;
  double driven_ = 0.0;   ///< m since the goal was set, from step to step
  Point2 best_position_;  ///< where the robot was nearest to the goal
  StepListener step_listener_;
  std::optional<int> imposed_action_;  ///< by the listener, or drawn
  double look_around_turn_ = 0.0;      ///< rad, sign of the turn while nothing is free
};

}  // namespace lstm_planner
