#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/range.hpp"

namespace lstm_planner {

// Each parameter is described in one place, the function visitXParameters(parameters, visit) beside the struct that
// holds it. For every parameter the function calls
//
//   visit(name, value, range, unit, meaning);
//
// with the name in the yaml files, the variable, the range of a number ({}: any number, or not a number), the unit, and
// a phrase. This is used to read parameters in ROS, to check ranges, to store parameters with recordings, for the
// options of the command-line tool, and for the table that `lstm_planner parameters` prints. If the yaml value has
// another type than the variable (an enum, for example), a local variable is visited and then copied, unless
// `parameters` are const.

template <typename T>
constexpr bool kIsNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// Throws std::invalid_argument for a number out of its range; see checkRange(). `prefix` is put before the names.
struct RangeCheck {
  template <typename T>
  void operator()(const std::string& name, const T& value, Range range, const char*, const char*) const {
    if constexpr (kIsNumber<T>) {
      if (range.isGiven()) checkRange(prefix + name, static_cast<double>(value), range.least, range.most);
    }
  }
  std::string prefix = {};
};

/// Calls another visitor with a prefix before the names.
template <typename Visitor>
auto withPrefix(const std::string& prefix, const Visitor& visit) {
  return [prefix, &visit](const std::string& name, auto& value, Range range, const char* unit, const char* meaning) {
    visit(prefix + name, value, range, unit, meaning);
  };
}

/// Calls another visitor for the parameters with the given names only.
template <typename Visitor>
auto onlyNamed(const std::vector<std::string>& names, const Visitor& visit) {
  return [names, &visit](const std::string& name, auto& value, Range range, const char* unit, const char* meaning) {
    if (std::find(names.begin(), names.end(), name) != names.end()) visit(name, value, range, unit, meaning);
  };
}

}  // namespace lstm_planner
