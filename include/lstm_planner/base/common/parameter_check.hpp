#pragma once

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace lstm_planner {

/// Throws std::invalid_argument "parameter NAME is VALUE, expected EXPECTED" if `fine` is false or the value is not
/// finite.
inline void checkParameter(bool fine, const std::string& name, double value, const std::string& expected) {
  if (fine && std::isfinite(value)) {
    return;
  }
  std::ostringstream message;
  message << "parameter " << name << " is " << value << ", expected " << expected;
  throw std::invalid_argument(message.str());
}

/// Throws std::invalid_argument naming the range unless least <= value <= most.
inline void checkRange(const std::string& name, double value, double least, double most) {
  if (value >= least && value <= most) return;
  std::ostringstream expected;
  expected << "a number in [" << least << ", " << most << "]";
  checkParameter(false, name, value, expected.str());
}

inline void checkPositive(const std::string& name, double value) {
  checkParameter(value > 0.0, name, value, "a positive number");
}

}  // namespace lstm_planner
