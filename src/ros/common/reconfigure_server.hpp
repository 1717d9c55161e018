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

/// Lets a plugin's parameters be changed while it drives, by dynamic_reconfigure (rqt_reconfigure, dynparam) in
/// "~/NAME". Made from the visited parameters; there is no .cfg file. Does nothing where dynamic_reconfigure was not
/// installed when this was built.
class ReconfigureServer {
 public:
  using Rows = std::vector<ParameterRow>;
  /// Takes over the rows; throws std::invalid_argument, and changes nothing, when one cannot be used.
  using Change = std::function<void(const Rows&)>;

  /// What may be changed, and from what to what.
  struct Description {
    Rows rows;      ///< as they are now
    Rows defaults;  ///< in the same order
    std::vector<std::string> changeable;
    std::vector<std::string> leaders;  ///< what `leader` may be
  };

  /// `mutex` is held during a change. Not to be destroyed under it.
  ReconfigureServer(const std::string& name, const Description& description, std::mutex* mutex, const Change& change);
  ~ReconfigureServer();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// For the parameters of `user`, which has parameters() and change(), and must outlive the server. `visit(parameters,
/// visitor)` visits them.
template <typename User, typename Visit>
std::unique_ptr<ReconfigureServer> makeReconfigureServer(const std::string& name, User* user, const Visit& visit,
                                                         const std::vector<std::string>& changeable,
                                                         const std::vector<std::string>& leaders, std::mutex* mutex) {
  using Parameters = std::decay_t<decltype(user->parameters())>;
  const auto change = [user, visit](const ReconfigureServer::Rows& rows) {
    Parameters changed = user->parameters();
    assignRows(rows, &changed, visit);
    validate(changed);
    user->change(changed);
  };
  const ReconfigureServer::Description description{rowsOf(user->parameters(), visit), rowsOf(Parameters(), visit),
                                                   changeable, leaders};
  return std::make_unique<ReconfigureServer>(name, description, mutex, change);
}

}  // namespace lstm_planner
