#include "ros/common/stamp_check.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {

bool StampCheck::isPlausible(double stamp, double received) {
  constexpr double kHour = 3600.0;  // s
  const bool is_near = stamp <= std::max(received, newest_.value_or(received)) + kHour;
  const bool is_other_clock = refused_ && std::abs(stamp - *refused_) <= kHour;
  if (is_near || is_other_clock) {
    newest_ = stamp;
    return true;
  }
  refused_ = stamp;
  return false;
}

}  // namespace lstm_planner
