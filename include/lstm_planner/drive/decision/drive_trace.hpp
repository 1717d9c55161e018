#pragma once

#include <optional>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/progress_watch.hpp"
#include "lstm_planner/drive/decision/place_trace.hpp"
#include "lstm_planner/drive/perception/observation.hpp"

namespace lstm_planner {

/// Remembers the robot's own drive to a goal: where it was, how near to the goal it came, and its last motion. It does
/// not know obstacles. Poses and goals are in the odometry frame. Not thread safe.
class DriveTrace {
 public:
  /// m, how much nearer to the goal than ever counts as progress.
  static constexpr double kProgress = 0.1;

  /// A new goal: forgets everything.
  void clear();

  /// Once a step: notes that the robot is at `pose`, and fills the fields of an observation that describe the drive so
  /// far (visits, places, progress, motion). For this it also uses the observation's sectors and goal distance.
  void update(const Pose2& pose, Observation* observation);

 private:
  void lookAround(const Pose2& pose, Observation* observation) const;
  void noteProgress(Observation* observation);
  void noteMotion(const Pose2& pose, Observation* observation);

  PlaceTrace places_;
  std::optional<Pose2> last_pose_;  ///< of the drive to this goal
  ProgressWatch progress_{kProgress};
};

}  // namespace lstm_planner
