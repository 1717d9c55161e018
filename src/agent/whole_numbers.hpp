#pragma once

namespace lstm_planner {

/// std::floor() without a call, which a plain x86-64 needs.
inline int floorOf(double value) {
  const int towards_zero = static_cast<int>(value);
  return towards_zero - (value < towards_zero ? 1 : 0);
}

}  // namespace lstm_planner
