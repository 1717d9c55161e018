#pragma once

#include <optional>

#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/drive/decision/drive_trace.hpp"
#include "lstm_planner/drive/local_map/replanner.hpp"
#include "lstm_planner/drive/perception/observation.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// Composes the network's inputs from what the robot senses and remembers. This is done only here, for the agent that
/// drives and for the recorder.
///
/// `trace`: of the drive so far; the situation's pose is added to it. `position_cell`: m, see observe().
Observation observe(const Situation& situation, const Point2& goal, double previous_action, double position_cell,
                    DriveTrace* trace);

/// What a recorder remembers of a drive, as the agent would: obstacles and places.
class Observer {
 public:
  /// Parameters that validate() accepts.
  explicit Observer(const AgentParameters& parameters)
      : parameters_(parameters), replanner_(parameters.memory, parameters.shield) {}

  /// A new goal (odometry frame): the drive so far is forgotten, the obstacles not.
  void start(const Point2& goal);
  /// The odometry jumped: everything is forgotten.
  void forget();
  /// The network's inputs at this step; the position is not rounded. In addition, for training: the direction in which
  /// the path through the obstacles seen so far starts, and its length.
  Observation observe(const Situation& situation, const Point2& goal, double previous_action);

 private:
  AgentParameters parameters_;
  Replanner replanner_;
  Point2 goal_;  ///< where it lay when it was observed last
  DriveTrace trace_;
  std::optional<Pose2> last_pose_;  ///< of the drive to this goal
  double driven_ = 0.0;             ///< m since it was set, from step to step
};

}  // namespace lstm_planner
