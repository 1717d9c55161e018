#pragma once

#include <cstddef>
#include <vector>

namespace lstm_planner {

/// What is added up over the steps that a critic has judged: how well it foresees the returns, and how much the
/// advantages vary in each set of the course.
struct CriticSums {
  explicit CriticSums(std::size_t sets = 0) : set_steps(sets), set_squared_advantages(sets) {}

  double steps = 0.0, returns = 0.0, squared_returns = 0.0;
  double squared_errors = 0.0;
  std::vector<double> set_steps, set_squared_advantages;

  /// A step in a set, whose state the critic values at `value`.
  void count(std::size_t set, double value, double advantage);

  /// Share of the variance of the returns.
  double explained() const;
  /// Moves the variances by that share towards those of these steps, of the sets that have some.
  void moveVariances(double share, std::vector<double>* variances) const;
};
std::vector<double*> numbersOf(CriticSums* sums);

}  // namespace lstm_planner
