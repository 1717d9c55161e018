#pragma once

#include "lstm_planner/base/common/geometry.hpp"
#include "lstm_planner/base/common/progress_watch.hpp"
#include "lstm_planner/robot/driving/place_trace.hpp"
#include "lstm_planner/robot/perception/observation.hpp"

namespace lstm_planner {

/// What is remembered of the robot's own drive to a goal: where it was, how near to the goal it came, how it moved
/// last. Of obstacles it knows nothing. Poses and goals are in the odometry frame. Not thread safe.
class DriveTrace {
 public:
  /// m, how much nearer to the goal than ever counts as progress.
  static constexpr double kProgress = 0.1;

  /// A new goal: forgets everything.
  void clear();

  /// Once a step: notes that the robot is at `pose`, and fills what an observation says of the drive so far (visits,
  /// places, progress, motion) from that and from the observation's own sectors and goal distance.
  void update(const Pose2& pose, Observation* observation);

 private:
  void lookAround(const Pose2& pose, Observation* observation) const;
  void noteProgress(Observation* observation);
  void noteMotion(const Pose2& pose, Observation* observation);

  PlaceTrace places_;
  bool has_pose_ = false;
  Pose2 last_pose_;
  ProgressWatch progress_{kProgress};
};

}  // namespace lstm_planner
