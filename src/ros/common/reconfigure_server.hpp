#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#include "lstm_planner/common/parameter_rows.hpp"

namespace lstm_planner {

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
