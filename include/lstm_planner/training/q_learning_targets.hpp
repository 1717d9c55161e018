#pragma once

#include <vector>

namespace lstm_planner {

/// One step of an agent. Values are in the reward's unit: cells in the grid world, m for the robot.
struct QTransition {
  int direction = 0;
  double estimate = 0.0;  ///< Q(s, a) of the move that was made, by the network that learns
  double reward = 0.0;
  double value = 0.0;   ///< max over a of Q(s, a) by the target network
  bool greedy = false;  ///< whether the move was the best by the network that learns
  bool arrived = false;
  bool timed_out = false;  ///< the episode was cut off after this step
};

/// What the estimates of consecutive steps should have been: r + gamma max_a' Q(s', a') for trace_decay 0 (Eq. 2.38),
/// for others Watkins's Q(lambda). Of the last of `steps`, which only says what the state after the others is worth,
/// nothing but the value counts; it gets no target.
///
/// Where an episode was cut off, the state after is unknown: the target is the estimate, so that nothing is learned.
std::vector<double> lambdaTargets(const std::vector<QTransition>& steps, double discount, double trace_decay);

/// Derivative of Huber's loss of estimate - target: the error, no larger than `huber`.
double huberDerivative(double error, double huber);

}  // namespace lstm_planner
