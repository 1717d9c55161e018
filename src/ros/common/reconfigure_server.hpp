#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
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

using ParameterRows = std::vector<ParameterRow>;

/// The parameters as rows. `visit(parameters, visitor)` visits them.
template <typename Parameters, typename Visit>
ParameterRows rowsOf(const Parameters& parameters, const Visit& visit) {
  ParameterRows rows;
  visit(parameters,
        [&rows](const std::string& name, const auto& value, Range range, const char* unit, const char* meaning) {
          rows.push_back({name, value, range, unit, meaning});
        });
  return rows;
}

/// Copies the values of rows into the parameters of the same name; the types must be equal.
template <typename Parameters, typename Visit>
void assignRows(const ParameterRows& rows, Parameters* parameters, const Visit& visit) {
  visit(*parameters, [&rows](const std::string& name, auto& value, Range, const char*, const char*) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&name](const auto& other) { return other.name == name; });
    if (row != rows.end()) value = std::get<std::decay_t<decltype(value)>>(row->value);
  });
}

/// What may be changed, and from what to what.
struct Reconfiguration {
  ParameterRows rows;      ///< as they are now
  ParameterRows defaults;  ///< in the same order
  std::vector<std::string> changeable;
  std::vector<std::string> leaders;  ///< what `leader` may be
  /// Takes over the rows; throws std::invalid_argument, and changes nothing, when one cannot be used.
  std::function<void(const ParameterRows&)> change;
};

/// Lets a plugin's parameters be changed while it drives, by dynamic_reconfigure (rqt_reconfigure, dynparam) in
/// "~/NAME", as long as the result lives. Made from the visited parameters; there is no .cfg file. Does nothing where
/// dynamic_reconfigure was not installed when this was built. `mutex` is held during a change; the result is not to be
/// destroyed under it.
std::shared_ptr<void> serveReconfiguration(const std::string& name, const Reconfiguration& reconfiguration,
                                           std::mutex* mutex);

/// For the parameters of `user`, which has parameters() and change(), and must outlive the result. `visit(parameters,
/// visitor)` visits them.
template <typename User, typename Visit>
std::shared_ptr<void> serveReconfiguration(const std::string& name, User* user, const Visit& visit,
                                           const std::vector<std::string>& changeable,
                                           const std::vector<std::string>& leaders, std::mutex* mutex) {
  using Parameters = std::decay_t<decltype(user->parameters())>;
  const auto change = [user, visit](const ParameterRows& rows) {
    Parameters changed = user->parameters();
    assignRows(rows, &changed, visit);
    validate(changed);
    user->change(changed);
  };
  return serveReconfiguration(
      name, {rowsOf(user->parameters(), visit), rowsOf(Parameters(), visit), changeable, leaders, change}, mutex);
}

}  // namespace lstm_planner
