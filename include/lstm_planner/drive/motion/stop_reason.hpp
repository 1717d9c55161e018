#pragma once

namespace lstm_planner {

/// Why the robot does not drive on.
enum class StopReason {
  kNone,         ///< it drives, or turns to where it will
  kArrived,      ///< at the end of the plan
  kNoPlan,       ///< waits for a plan
  kObstacle,     ///< something is within the margin of where it would drive
  kPerson,       ///< yields to what moves, or has moved
  kStuck,        ///< it has stood before an obstacle, or tried in vain to move, for longer than the patience
  kOldPlan,      ///< the plan is not renewed
  kUnusableData  ///< a pose, scan, odometry or transform is missing, too old, or makes no sense
};

/// A few words on it, such as "it yields to somebody who moves".
const char* toString(StopReason reason);

}  // namespace lstm_planner
