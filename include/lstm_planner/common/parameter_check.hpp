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

/// Whether value <= limit, except for rounding: the last digits of a limit that is computed from other parameters may
/// be wrong.
inline bool isAtMost(double value, double limit) {
  constexpr double kRounding = 1e-9;  // of the limit
  return value <= limit + kRounding * std::abs(limit);
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

inline void checkAtLeastOne(const std::string& name, int value) {
  checkParameter(value >= 1, name, value, "at least 1");
}

inline void checkNotNegative(const std::string& name, double value) {
  checkParameter(value >= 0.0, name, value, "a number that is not negative");
}

}  // namespace lstm_planner
