#pragma once

#include <vector>

#include "lstm_planner/agent/navigation_agent.hpp"

namespace lstm_planner {

/// How a decision becomes a plan.
struct RolloutParameters {
  double spacing = 0.05;  ///< m between poses; about the costmap's resolution, or move_base prunes the plan away
  int steps = 8;          ///< steps beyond the waypoint, through free space that the scan shows
};

/// The plan of a decision: from the robot's pose through the waypoint, on towards the goal through what the scan shows
/// free, then straight to the goal. Dense; starts exactly at the pose and ends exactly at the goal with the goal's yaw;
/// all other poses look along the plan. Overwrites `plan`, reusing its memory.
void rollOut(const Situation& situation, const Decision& decision, const Shield& shield, const Pose2& goal,
             const AgentParameters& agent, const RolloutParameters& parameters, std::vector<Pose2>* plan);

}  // namespace lstm_planner
