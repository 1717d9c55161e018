#pragma once

#include <string>

#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/drive/decision/decision.hpp"

namespace lstm_planner {

// Where a drive ends. The agent decides where the plan ends, and a robot has arrived when its controller finds it
// there, within its tolerances (MotionController::goalReached()). Nobody else says that a robot has arrived.

/// Whether the decision's path ends beside the goal: farther from it than AgentParameters::goal_tolerance.
bool endsBesideGoal(const Decision& decision, const Point2& goal, const AgentParameters& parameters);

/// Whether a robot at the end of the decision's path has arrived: at the goal, or beside it where that counts
/// (AgentParameters::arrive_beside_goal).
bool countsAsArrival(const Decision& decision, const Point2& goal, const AgentParameters& parameters);

/// Where the plan ends: at the decision's destination; at the goal itself where the destination does not count, so that
/// no controller takes the one for the other.
Point2 endOfPlan(const Decision& decision, const Point2& goal, const AgentParameters& parameters);

/// What is to be said of a robot that stopped so far (m) from the goal, because its path ends beside it.
std::string besideGoalText(double distance);

}  // namespace lstm_planner
