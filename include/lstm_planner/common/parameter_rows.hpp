#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "lstm_planner/common/range.hpp"

namespace lstm_planner {

/// One visited parameter (parameter_visitors.hpp) as data, for code that shows or changes parameters.
struct ParameterRow {
  using Value = std::variant<bool, int, double, std::string>;
  std::string name;
  Value value;
  Range range;
  std::string unit;
  std::string meaning;
};

/// The parameters as rows. `visit(parameters, visitor)` visits them.
template <typename Parameters, typename Visit>
std::vector<ParameterRow> rowsOf(const Parameters& parameters, const Visit& visit) {
  std::vector<ParameterRow> rows;
  visit(parameters,
        [&rows](const std::string& name, const auto& value, Range range, const char* unit, const char* meaning) {
          rows.push_back({name, value, range, unit, meaning});
        });
  return rows;
}

/// Copies the values of rows into the parameters of the same name; the types must be equal.
template <typename Parameters, typename Visit>
void assignRows(const std::vector<ParameterRow>& rows, Parameters* parameters, const Visit& visit) {
  visit(*parameters, [&rows](const std::string& name, auto& value, Range, const char*, const char*) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&name](const auto& other) { return other.name == name; });
    if (row != rows.end()) value = std::get<std::decay_t<decltype(value)>>(row->value);
  });
}

}  // namespace lstm_planner
