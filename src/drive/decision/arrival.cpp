#include "lstm_planner/drive/decision/arrival.hpp"

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

bool endsBesideGoal(const Decision& decision, const Point2& goal, const AgentParameters& parameters) {
  return distanceBetween(decision.destination, goal) > parameters.goal_tolerance;
}

bool countsAsArrival(const Decision& decision, const Point2& goal, const AgentParameters& parameters) {
  return parameters.arrive_beside_goal || !endsBesideGoal(decision, goal, parameters);
}

Point2 endOfPlan(const Decision& decision, const Point2& goal, const AgentParameters& parameters) {
  return countsAsArrival(decision, goal, parameters) ? decision.destination : goal;
}

std::string besideGoalText(double distance) {
  return "stopped " + fixedText(distance, 2) +
         " m from the goal, which seems to lie in or behind an obstacle (goal_drift)";
}

}  // namespace lstm_planner
