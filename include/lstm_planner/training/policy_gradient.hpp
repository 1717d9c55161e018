#pragma once

#include <algorithm>
#include <cmath>

#include "lstm_planner/common/random.hpp"

namespace lstm_planner {

// How a policy draws its actions, and how it learns: the same in every course. Chances and probabilities are arrays
// with one number for each action; it is 0 for an action that is not possible. Chances need not add up to 1.

/// Writes the chances of the actions, exp(preference - largest preference), which are those of a softmax times their
/// sum. `possible(action)`: bool; `preference(action)`: float. Returns the sum of the chances, 0 if no action is
/// possible.
template <typename Number, typename Possible, typename Preference>
Number fillChances(int actions, const Possible& possible, const Preference& preference, Number* chances) {
  float largest = -1e30f;
  for (int action = 0; action < actions; ++action) {
    if (possible(action)) largest = std::max(largest, preference(action));
  }
  Number total = 0;
  for (int action = 0; action < actions; ++action) {
    chances[action] = possible(action) ? std::exp(static_cast<Number>(preference(action) - largest)) : Number(0);
    total += chances[action];
  }
  return total;
}

/// Draws an action by chances whose sum is `total`, above 0, and divides them by it, so that they become probabilities.
inline int drawByChances(int actions, float total, Random* random, float* chances) {
  float draw = static_cast<float>(uniform(*random)) * total;
  int drawn = -1;
  for (int action = 0; action < actions; ++action) {
    if (chances[action] > 0.0f && (draw >= 0.0f || drawn < 0)) drawn = action;
    draw -= chances[action];
    chances[action] /= total;
  }
  return drawn;
}

/// Entropy of the probabilities, nat.
template <typename Number>
double entropyOf(int actions, const Number* probabilities) {
  double entropy = 0.0;
  for (int action = 0; action < actions; ++action) {
    const auto probability = static_cast<double>(probabilities[action]);
    if (probability > 0.0) entropy -= probability * std::log(probability);
  }
  return entropy;
}

/// Derivative of -log(probability of the action that was done) by the preference for an action with `probability`.
inline double imitationSlope(double probability, bool done) { return probability - (done ? 1.0 : 0.0); }

/// Derivative of -(gain * log(probability of the action that was done) + entropy_weight * entropy) by the preference
/// for an action with `probability`, above 0. `entropy` is that of all actions, nat.
inline double policySlope(double probability, bool done, double gain, double entropy_weight, double entropy) {
  return entropy_weight * probability * (std::log(probability) + entropy) + gain * imitationSlope(probability, done);
}

}  // namespace lstm_planner
