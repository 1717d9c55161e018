#pragma once

#include <sstream>
#include <string>

#include "lstm_planner/parameter_check.hpp"

namespace lstm_planner {

/// Throws std::invalid_argument unless low <= value <= high.
inline void checkRange(const std::string& name, double value, double low, double high) {
  std::ostringstream expected;
  expected << "a number in [" << low << ", " << high << "]";
  checkParameter(value >= low && value <= high, name, value, expected.str());
}

}  // namespace lstm_planner
