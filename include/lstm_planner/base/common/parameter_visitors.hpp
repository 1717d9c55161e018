#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/base/common/range.hpp"

namespace lstm_planner {

// Each parameter is told in one place, a function visitXParameters(parameters, visit) beside the struct that holds it.
// It calls, for every parameter,
//
//   visit(name, value, range, unit, meaning);
//
// with the name that it has in the yaml files, the variable itself, for numbers what they may be ({} for any number,
// and for what is no number), the unit and a phrase that may follow it. From that follow the reading of parameters in
// ROS, the check of their ranges, what is stored with recordings, options of the command-line tool and the table that
// `lstm_planner parameters` prints. A parameter whose variable is not what is written (an enum, say) is visited as a
// variable of its own that is then taken over, unless `parameters` are const.

template <typename T>
constexpr bool kIsNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// Refuses numbers out of their range; see checkRange(). `prefix` stands before the names.
struct RangeCheck {
  template <typename T>
  void operator()(const std::string& name, const T& value, Range range, const char*, const char*) const {
    if constexpr (kIsNumber<T>) {
      if (range.isGiven()) checkRange(prefix + name, static_cast<double>(value), range.least, range.most);
    }
  }
  std::string prefix = {};
};

/// Passes all on with a prefix before the names.
template <typename Visitor>
auto withPrefix(const std::string& prefix, const Visitor& visit) {
  return [prefix, &visit](const std::string& name, auto& value, Range range, const char* unit, const char* meaning) {
    visit(prefix + name, value, range, unit, meaning);
  };
}

/// Passes on what has one of the names.
template <typename Visitor>
auto onlyNamed(const std::vector<std::string>& names, const Visitor& visit) {
  return [names, &visit](const std::string& name, auto& value, Range range, const char* unit, const char* meaning) {
    if (std::find(names.begin(), names.end(), name) != names.end()) visit(name, value, range, unit, meaning);
  };
}

}  // namespace lstm_planner
