#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/robot/driving/agent_parameters.hpp"
#include "lstm_planner/robot/driving/drive_policy.hpp"
#include "lstm_planner/robot/driving/drive_trace.hpp"
#include "lstm_planner/robot/driving/escape.hpp"
#include "lstm_planner/robot/driving/shield.hpp"
#include "lstm_planner/robot/memory/route_guide.hpp"
#include "lstm_planner/robot/perception/situation.hpp"

namespace lstm_planner {

/// One decision: where to go next, and why.
struct Decision {
  enum class Source {
    kNetwork,      ///< the allowed action that the network prefers
    kGreedy,       ///< the allowed action nearest to the goal's bearing, where no network leads
    kGoalInSight,  ///< the goal is near and the straight way free
    kRoute,        ///< the way through what is remembered: it always leads, or there was no progress
    kEscape,       ///< boundary following: no way through what is remembered led on either
    kLookAround,   ///< nothing is free in sight: turn
    kArrived,      ///< within the goal tolerance
    kNoWay         ///< the way around has been followed to its end: the goal cannot be reached
  };
  Source source = Source::kLookAround;
  Point2 waypoint;                 ///< odometry frame
  double direction = 0.0;          ///< rad, odometry frame, from where the decision was made to the waypoint
  int action = -1;                 ///< index of the steering angle; -1 when the waypoint is not one of them
  int preferred = -1;              ///< the action that the network prefers of all; -1 when none is asked
  std::vector<float> preferences;  ///< the network's, one an action
  std::vector<char> allowed;       ///< the shield's word, one an action
  bool on_route = false;           ///< the waypoint lies on, or beside, the way through what is remembered
  Point2 destination;              ///< where the plan ends: the goal, or where the footprint still fits when the goal
                                   ///< lies in something (AgentParameters::goal_drift)
  std::vector<Point2> way_on;      ///< from the waypoint to the destination through what is remembered; empty unless the
                                   ///< waypoint is on it
  long step = 0;                   ///< counts the steps since the goal was set

  /// The network's favourite was not taken: the shield forbids it, or the network does not lead.
  bool isOverruled() const { return preferred >= 0 && action != preferred; }
};

constexpr std::size_t kDecisionSources = 8;
const char* toString(Decision::Source source);

/// Decides, step by step, where the robot goes: network -> shield -> rescue.
///
/// The network is told what is seen and where the robot was. As long as the robot comes nearer to the goal nothing is
/// searched; what is seen is only remembered. Without progress comes the rescue: the way through what is remembered leads
/// (RouteGuide) until the robot is nearer to the goal than ever, and if even that leads nowhere boundaries are followed
/// (Escape). Each time that the network takes over again is strictly nearer to the goal.
///
/// AgentParameters::leader puts the route, or nothing but the goal's bearing, in the network's place.
///
/// The hidden state advances once a step (StepParameters) and at no other time: asking twice gives the same answer. Not
/// thread safe. All poses and goals are in the odometry frame.
class NavigationAgent {
 public:
  /// Throws std::invalid_argument for bad parameters or a policy that does not fit them.
  NavigationAgent(DrivePolicy policy, const AgentParameters& parameters);

  /// A new goal: forgets the hidden state, the step and the escape, but not what was seen on the way.
  void setGoal(const Point2& goal);
  const Point2& goal() const { return goal_; }

  /// The same goal lies a little elsewhere in the odometry frame, because localisation was corrected: forgets nothing.
  void moveGoal(const Point2& goal);

  /// The odometry jumped: what was seen is somewhere else now. Forgets it, and all that setGoal() forgets.
  void restart();

  /// The decision that holds now; makes a new one when the last step is over or its way is blocked.
  const Decision& update(const Situation& situation);

  /// What update() would answer for a goal that has just been set; changes nothing that update() depends on.
  Decision preview(const Situation& situation, const Point2& goal) const;

  /// Called once a step, after the network has advanced, with what it was told. An action that comes back is taken in
  /// place of the network's own if the shield allows it: this is how a teacher takes the wheel.
  using StepListener = std::function<std::optional<int>(const Situation&, const Observation&)>;
  void setStepListener(StepListener listener) { step_listener_ = std::move(listener); }

  /// What was decided last.
  const Decision& decision() const { return decision_; }
  const Shield& shield() const { return shield_; }
  /// Searches for ways through what is remembered, so far.
  long searches() const { return guide_ ? guide_->searches() : 0; }
  const AgentParameters& parameters() const { return parameters_; }
  const DrivePolicy& policy() const { return policy_; }
  double bestDistance() const { return best_distance_; }

 private:
  /// Who leads now.
  enum class Phase { kLeader, kRoute, kBoundary };

  bool stepIsOver(const Situation& situation) const;
  bool hasStirred(const Situation& situation, const Pose2& since) const;
  double elapsed(const Situation& situation) const;
  bool isStalled(const Situation& situation);
  bool wayIsFree(const Situation& situation) const;
  void noteProgress(const Situation& situation);
  void beginFrom(const Situation& situation);
  /// How near to the goal, m, counts as progress.
  double targetDistance() const { return best_distance_ - parameters_.escape.progress; }
  void lead(Phase phase);
  void losePatience();
  bool isOutOfPatience(double times) const;
  void guide(const Situation& situation);
  void beginStep(const Situation& situation);
  void advanceNetwork(const Observation& observation);
  void preferGoal(const Observation& observation);
  double previousAction() const;
  void choose(const Situation& situation);
  void chooseEscape(const Situation& situation);
  void chooseRoute(const Situation& situation);
  void chooseAction(const Situation& situation);
  void chooseByPhase(const Situation& situation);
  int allowedFavourite(const Situation& situation, double clearance, double* free);
  bool followRoute(const Situation& situation);
  bool chooseGoalInSight(const Situation& situation);
  void lookAround(const Situation& situation);
  void goTo(const Situation& situation, Decision::Source source, double direction, double distance);
  void planWayOn();
  double freeDistance(const Situation& situation, double direction, double limit, double clearance) const;

  DrivePolicy policy_;
  AgentParameters parameters_;
  Shield shield_;
  Escape escape_;
  std::optional<RouteGuide> guide_;  ///< none where nothing is to be remembered
  RouteGuide::Status guide_status_ = RouteGuide::Status::kRoute;
  DriveTrace trace_;
  Point2 goal_;
  Decision decision_;
  Pose2 step_pose_;          ///< where the current step began
  double step_time_ = 0.0;   ///< s
  Pose2 stall_pose_;         ///< where the robot has been since stall_time_
  double stall_time_ = 0.0;  ///< s
  bool has_step_ = false;
  Phase phase_ = Phase::kLeader;
  Point2 best_position_;        ///< where the robot was nearest to the goal
  double best_distance_ = 0.0;  ///< m, from there to the goal
  StepListener step_listener_;
  std::optional<int> imposed_action_;
  int steps_since_best_ = 0;
  double driven_since_best_ = 0.0;  ///< m
  double look_around_turn_ = 0.0;   ///< rad, sign of the turn while nothing is free
};

}  // namespace lstm_planner
