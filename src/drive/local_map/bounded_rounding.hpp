#pragma once

#include <cmath>

namespace lstm_planner {

/// The nearest number within +-`most`; NaN is taken as -`most`. A conversion to a whole number is undefined otherwise.
inline double bounded(double value, double most) {
  const double at_least = value > -most ? value : -most;
  return at_least < most ? at_least : most;
}

/// std::floor() without a call, which a plain x86-64 needs; within +-2^30, so that differences can be taken.
inline int floorOf(double value) {
  value = bounded(value, 1 << 30);
  const int towards_zero = static_cast<int>(value);
  return towards_zero - (value < towards_zero ? 1 : 0);
}

/// std::lround() within +-2^28, so that it can be multiplied by what a step of the route search costs.
inline int roundOf(double value) { return static_cast<int>(std::lround(bounded(value, 1 << 28))); }

}  // namespace lstm_planner
