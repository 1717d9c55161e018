#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "lstm_planner/base/common/range.hpp"

namespace lstm_planner {

/// One visited parameter (parameter_visitors.hpp) as data, to be shown and changed by somebody else.
struct ParameterRow {
  using Value = std::variant<bool, int, double, std::string>;
  std::string name;
  Value value;
  Range range;
  std::string unit;
  std::string meaning;
};

/// `visit(parameters, visitor)` visits the parameters.
template <typename Parameters, typename Visit>
std::vector<ParameterRow> rowsOf(const Parameters& parameters, const Visit& visit) {
  std::vector<ParameterRow> rows;
  visit(parameters,
        [&rows](const std::string& name, const auto& value, Range range, const char* unit, const char* meaning) {
          rows.push_back({name, value, range, unit, meaning});
        });
  return rows;
}

/// Takes over the values of rows that are named as a parameter; their types must be the parameter's.
template <typename Parameters, typename Visit>
void assignRows(const std::vector<ParameterRow>& rows, Parameters* parameters, const Visit& visit) {
  visit(*parameters, [&rows](const std::string& name, auto& value, Range, const char*, const char*) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&name](const auto& other) { return other.name == name; });
    if (row != rows.end()) value = std::get<std::decay_t<decltype(value)>>(row->value);
  });
}

}  // namespace lstm_planner
