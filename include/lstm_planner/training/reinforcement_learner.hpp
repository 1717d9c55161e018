#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/network/layers.hpp"

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

  // Q-learning.
  double epsilon = 0.0;  ///< share of actions at random, in the last update
  double value = 0.0;    ///< mean of the actions taken: where it grows and grows, learning diverges
  double error = 0.0;    ///< root of the mean squared error of these values, before the update
};

/// A network that learns by reinforcement, update by update.
class ReinforcementLearner {
 public:
  virtual ~ReinforcementLearner() = default;

  virtual int updates() const = 0;  ///< done so far
  virtual const LayerStack& layers() const = 0;

  /// Everything that the next update depends on.
  virtual std::vector<std::uint8_t> checkpoint() const = 0;
  /// Throws std::invalid_argument when it is not a checkpoint of the same networks.
  virtual void restore(const std::vector<std::uint8_t>& checkpoint) = 0;
};

}  // namespace lstm_planner
