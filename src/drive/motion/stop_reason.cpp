#include "lstm_planner/drive/motion/stop_reason.hpp"

namespace lstm_planner {

const char* toString(StopReason reason) {
  switch (reason) {
    case StopReason::kNone:
      return "it drives";
    case StopReason::kArrived:
      return "it has arrived";
    case StopReason::kNoPlan:
      return "there is no plan to follow";
    case StopReason::kObstacle:
      return "an obstacle is within the safety margin of where it would drive";
    case StopReason::kPerson:
      return "it yields to somebody who moves, or has just moved";
    case StopReason::kStuck:
      return "it has not got away from this place for longer than patience";
    case StopReason::kOldPlan:
      return "the plan is too old";
    case StopReason::kUnusableData:
      return "scan, odometry or a transform cannot be used";
  }
  return "unknown";
}

}  // namespace lstm_planner
