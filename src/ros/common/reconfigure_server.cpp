#include "ros/common/reconfigure_server.hpp"

#ifdef LSTM_PLANNER_HAVE_DYNAMIC_RECONFIGURE

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/drive/plugin_parameters.hpp"

namespace lstm_planner {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigDescription;
using Value = ParameterRow::Value;

const char* typeName(const Value& value) {
  constexpr const char* kNames[] = {"bool", "int", "double", "str"};
  return kNames[value.index()];
}

template <typename Entry, typename T>
void addTo(const std::string& name, const T& value, std::vector<Entry>* entries) {
  Entry entry;
  entry.name = name;
  entry.value = value;
  entries->push_back(entry);
}

struct AddTo {
  const std::string& name;
  Config* config;
  void operator()(bool value) const { addTo(name, value, &config->bools); }
  void operator()(int value) const { addTo(name, value, &config->ints); }
  void operator()(double value) const { addTo(name, value, &config->doubles); }
  void operator()(const std::string& value) const { addTo(name, value, &config->strs); }
};

Config toMessage(const ParameterRows& rows) {
  Config config;
  for (const ParameterRow& row : rows) std::visit(AddTo{row.name, &config}, row.value);
  dynamic_reconfigure::GroupState group;
  group.name = "Default";
  group.state = true;
  config.groups.push_back(group);
  return config;
}

/// What a parameter is at most, or at least.
Value limitOf(const ParameterRow& row, bool most) {
  const double limit = most ? row.range.most : row.range.least;
  const auto choose = [&](const auto& value) -> Value {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, bool>) {
      return most;
    } else if constexpr (std::is_same_v<T, std::string>) {
      return std::string();
    } else if (row.range.isGiven()) {
      return static_cast<T>(limit);
    } else {
      return most ? std::numeric_limits<T>::max() : std::numeric_limits<T>::lowest();
    }
  };
  return std::visit(choose, row.value);
}

Config limitsOf(ParameterRows rows, bool most) {
  for (ParameterRow& row : rows) row.value = limitOf(row, most);
  return toMessage(rows);
}

/// A menu, as dynamic_reconfigure writes it.
std::string menuOf(const std::vector<std::string>& names) {
  std::string entries;
  for (const std::string& name : names) {
    entries += std::string(entries.empty() ? "" : ", ") + "{'name': '" + name + "', 'type': 'str', 'value': '" + name +
               "', 'srcline': 0, 'srcfile': '', 'description': '', 'ctype': 'std::string', 'cconsttype': ''}";
  }
  return "{'enum': [" + entries + "], 'enum_description': ''}";
}

/// The values that are asked for, in one form.
std::vector<std::pair<std::string, Value>> valuesOf(const Config& config) {
  std::vector<std::pair<std::string, Value>> values;
  for (const auto& entry : config.bools) values.emplace_back(entry.name, static_cast<bool>(entry.value));
  for (const auto& entry : config.ints) values.emplace_back(entry.name, static_cast<int>(entry.value));
  for (const auto& entry : config.doubles) values.emplace_back(entry.name, entry.value);
  for (const auto& entry : config.strs) values.emplace_back(entry.name, entry.value);
  return values;
}

class ReconfigureServer {
 public:
  ReconfigureServer(const std::string& name, const Reconfiguration& reconfiguration, std::mutex* mutex)
      : node_(ros::NodeHandle("~/" + name)), reconfiguration_(reconfiguration), mutex_(*mutex) {
    descriptions_ = node_.advertise<ConfigDescription>("parameter_descriptions", 1, true);
    updates_ = node_.advertise<Config>("parameter_updates", 1, true);
    descriptions_.publish(describe());
    updates_.publish(toMessage(reconfiguration_.rows));
    service_ = node_.advertiseService("set_parameters", &ReconfigureServer::onRequest, this);
  }

 private:
  using Request = dynamic_reconfigure::Reconfigure::Request;
  using Response = dynamic_reconfigure::Reconfigure::Response;

  bool isChangeable(const std::string& name) const { return contains(reconfiguration_.changeable, name); }

  ConfigDescription describe() const {
    ConfigDescription message;
    dynamic_reconfigure::Group group;
    group.name = "Default";
    for (const ParameterRow& row : reconfiguration_.rows) {
      dynamic_reconfigure::ParamDescription parameter;
      parameter.name = row.name;
      parameter.type = typeName(row.value);
      parameter.description = (row.unit.empty() ? "" : row.unit + ", ") + row.meaning +
                              (isChangeable(row.name) ? "" : " (needs a restart)");
      if (row.name == "leader") parameter.edit_method = menuOf(reconfiguration_.leaders);
      group.parameters.push_back(parameter);
    }
    message.groups.push_back(group);
    message.min = limitsOf(reconfiguration_.rows, false);
    message.max = limitsOf(reconfiguration_.rows, true);
    message.dflt = toMessage(reconfiguration_.defaults);
    return message;
  }

  bool onRequest(Request& request, Response& response) {
    try {
      ParameterRows rows = reconfiguration_.rows;
      const ParameterRows changed = apply(request.config, &rows);
      if (!changed.empty()) {
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          reconfiguration_.change(rows);
        }
        reconfiguration_.rows = rows;
        for (const ParameterRow& row : changed) tell(row);
      }
    } catch (const std::exception& error) {
      ROS_WARN("no parameter is changed: %s", error.what());
    }
    response.config = toMessage(reconfiguration_.rows);
    updates_.publish(response.config);
    return true;
  }

  /// Writes what is asked for into the rows; returns those that are different now.
  ParameterRows apply(const Config& config, ParameterRows* rows) const {
    ParameterRows changed;
    for (const auto& [name, value] : valuesOf(config)) {
      const std::string& wanted = name;
      const auto row = std::find_if(rows->begin(), rows->end(), [&](const auto& one) { return one.name == wanted; });
      if (row == rows->end()) {
        throw std::invalid_argument("there is no parameter " + name + hintAtParameter(name, names()));
      }
      if (row->value.index() != value.index()) {
        throw std::invalid_argument("parameter " + name + " is given as " + typeName(value) + ", expected " +
                                    typeName(row->value));
      }
      if (row->value == value) continue;
      if (!isChangeable(name)) throw std::invalid_argument("parameter " + name + " needs a restart");
      row->value = value;
      changed.push_back(*row);
    }
    return changed;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const ParameterRow& row : reconfiguration_.rows) names.push_back(row.name);
    return names;
  }

  /// The parameter server and the log.
  void tell(const ParameterRow& row) {
    std::visit([&](const auto& value) { node_.setParam(row.name, value); }, row.value);
    ROS_INFO("parameter %s was changed", node_.resolveName(row.name).c_str());
  }

  ros::NodeHandle node_;
  Reconfiguration reconfiguration_;
  std::mutex& mutex_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;  ///< last: its calls use what is above
};

}  // namespace

std::shared_ptr<void> serveReconfiguration(const std::string& name, const Reconfiguration& reconfiguration,
                                           std::mutex* mutex) {
  return std::make_shared<ReconfigureServer>(name, reconfiguration, mutex);
}

}  // namespace lstm_planner

#else

namespace lstm_planner {

std::shared_ptr<void> serveReconfiguration(const std::string& /*name*/, const Reconfiguration& /*reconfiguration*/,
                                           std::mutex* /*mutex*/) {
  return nullptr;
}

}  // namespace lstm_planner

#endif
