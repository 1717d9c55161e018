#pragma once

namespace lstm_planner {

/// What the agents of a learner did. Lengths and rewards are in the unit of the agents' world: cells, or m.
struct ReinforcementReport {
  int update = 0;        ///< from 1
  double steps = 0.0;    ///< of all agents since the start
  double reward = 0.0;   ///< mean: a step in the grid world, a drive of the robot
  double arrival = 0.0;  ///< share of the episodes that ended by arriving
  double ratio = 0.0;    ///< mean length / optimum of those; in the grid world

  // Actor-critic.
  double entropy = 0.0;    ///< mean, nat
  double explained = 0.0;  ///< share of the returns' variance that the critic explains
};

}  // namespace lstm_planner
