#pragma once

#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// Whether a robot has driven a step: a step's length or turn, or it is at the waypoint. Poses in the odometry frame.
bool isStepDriven(const StepParameters& step, const Pose2& start, const Pose2& pose, const Point2& waypoint);

/// Decides when a step is over, and when the robot stands still during a step. Both also work if the clock jumps back
/// (a simulation was started again).
class StepClock {
 public:
  explicit StepClock(const StepParameters& parameters) : parameters_(parameters) {}

  /// No step has started.
  void clear() { has_step_ = false; }
  bool hasStep() const { return has_step_; }

  /// A step starts.
  void start(const Situation& situation);
  /// Where it started.
  const Pose2& pose() const { return pose_; }
  /// m from there.
  double moved(const Situation& situation) const { return distanceBetween(pose_, situation.pose); }

  /// Driven, or it has taken its time and the robot has moved at all.
  bool isOver(const Situation& situation, const Point2& waypoint) const;

  /// The robot has stood still for too long, since the step started or since the last call that said so.
  bool isStalled(const Situation& situation);
  /// How often isStalled() has said so since the robot moved or turned last, or the step started.
  int stalls() const { return stalls_; }

 private:
  bool hasMoved(const Situation& situation, const Pose2& since) const;

  StepParameters parameters_;
  bool has_step_ = false;
  Pose2 pose_;
  double time_ = 0.0;        ///< s
  Pose2 stall_pose_;         ///< where the robot has been since stall_time_
  double stall_time_ = 0.0;  ///< s
  int stalls_ = 0;
};

}  // namespace lstm_planner
