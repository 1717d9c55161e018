#include "lstm_planner/drive/decision/observer.hpp"

namespace lstm_planner {

Observation observe(const Situation& situation, const Point2& goal, double previous_action, double position_cell,
                    DriveTrace* trace) {
  Observation observation = observe(situation.sectors, situation.pose, goal, previous_action, position_cell);
  trace->update(situation.pose, &observation);
  return observation;
}

void Observer::start(const Point2& goal) {
  goal_ = goal;
  replanner_.start();
  trace_.clear();
  last_pose_.reset();
  driven_ = 0.0;
}

void Observer::forget() {
  replanner_.forget();
  trace_.clear();
  last_pose_.reset();
}

Observation Observer::observe(const Situation& situation, const Point2& goal, double previous_action) {
  Observation observation = lstm_planner::observe(situation, goal, previous_action, 0.0, &trace_);
  replanner_.moveGoal(goal_, goal);
  goal_ = goal;
  if (last_pose_) driven_ += distanceBetween(*last_pose_, situation.pose);
  last_pose_ = situation.pose;
  if (!parameters_.memory.enabled) return observation;
  if (replanner_.update(situation, goal, toleranceAfter(driven_, parameters_)) == Replanner::Answer::kRoute) {
    observation.route_bearing = replanner_.bearingAhead(situation.pose, parameters_.step.length);
    observation.route_length = replanner_.route().length;
  }
  return observation;
}

}  // namespace lstm_planner
