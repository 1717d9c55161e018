#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/drive/decision/decision.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// How a decision becomes a plan. What each means: visitRolloutParameters().
struct RolloutParameters {
  double spacing = 0.05;
  int steps = 8;
  double clearance = 0.0;
};

/// Visits every parameter; see parameter_visitors.hpp: move_base drops the start of a plan whose poses are a metre
/// apart, and each step costs as much as a decision's.
template <typename Parameters, typename Visitor>
void visitRolloutParameters(Parameters& rollout, const Visitor& visit) {
  visit("rollout/spacing", rollout.spacing, {0.01, 0.5}, "m",
        "distance between poses; about the costmap's resolution, because move_base drops the start of a sparse plan");
  visit("rollout/steps", rollout.steps, {0, 100}, "",
        "number of steps beyond the waypoint, through free space that the scan shows; more makes the plan smoother");
  visit(
      "rollout/clearance", rollout.clearance, {0.0, 2.0}, "m",
      "distance between footprint and obstacles to which the plan is bent where there is room: round corners in arcs, "
      "and through the middle of doors; for local planners that cut corners; 0: the plan is the shortest path");
}

/// A plan has no more poses than this, however far away the goal is: 1.5 MB as messages.
constexpr std::size_t kMostPlanPoses = 10000;
/// The first poses of a plan, which are as dense as RolloutParameters say: 400 m with a spacing of 0.05 m. The rest of
/// the plan is replaced long before the robot is there; it gets the remaining poses, evenly spaced.
constexpr std::size_t kMostDensePlanPoses = 8000;

/// The plan of a decision: from the robot's pose through the waypoint, on towards the goal through what the scan shows
/// free, then straight to the end (endOfPlan()). Dense up to kMostDensePlanPoses; starts exactly at the pose and ends
/// exactly there with the goal's yaw; all other poses look along the plan. Overwrites `plan`, reusing its memory.
void rollOut(const Situation& situation, const Decision& decision, const Shield& shield, const Pose2& goal,
             const AgentParameters& agent, const RolloutParameters& parameters, std::vector<Pose2>* plan);

}  // namespace lstm_planner
