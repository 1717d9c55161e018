#include "lstm_planner/drive/decision/arrival.hpp"

#include <iomanip>
#include <sstream>

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
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "stopped " << distance
       << " m from the goal, which seems to lie in or behind an obstacle (goal_drift)";
  return text.str();
}

}  // namespace lstm_planner
