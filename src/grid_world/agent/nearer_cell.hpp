#pragma once

#include "lstm_planner/grid_world/agent/boundary_edge.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

// Where a bug algorithm goes on towards the goal, and how it turns at what keeps it from there. Directions are those
// of rays; kNoPath: there is none.

/// To the neighbour that is nearer to the goal than `best`; of several, where the path to the goal can be kept longest.
int directionToNearerNeighbour(const GridObservation& observation, OctileDistance best, CornerCutting corner_cutting);

/// How many steps an agent can go straight on: a diagonal ray passes between blocked cells where the agent may not.
int openSteps(const GridObservation& observation, int direction, CornerCutting corner_cutting);

/// The straight direction in which the agent sees a cell that is nearer to the goal than `best`; of several, the one
/// with the fewest steps.
int directionToNearerCell(const GridObservation& observation, OctileDistance best);

/// The straight direction that leads towards the goal most: where no neighbour is nearer, an obstacle lies there.
int directionOfObstacle(const GridObservation& observation);

/// The hand to keep on an obstacle in that direction at first: to the side that is open for longer, because a wall
/// across it would lead back, away from the goal.
WallSide firstWallSide(const GridObservation& observation, int obstacle);

}  // namespace lstm_planner
