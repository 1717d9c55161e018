#pragma once

#include <ros/node_handle.h>

#include <set>
#include <string>
#include <vector>

namespace lstm_planner {

/// Reads the parameters of one namespace into variables that hold their defaults.
class ParameterReader {
 public:
  /// Reads what the functions visit that name every number of some parameters: visitAgentNumbers() and the like.
  struct Numbers {
    template <typename T>
    void operator()(const std::string& name, T& value, double, double) const {
      reader->read(prefix + name, &value);
    }
    ParameterReader* reader;
    std::string prefix;
  };
  Numbers numbers(const std::string& prefix = "") { return {this, prefix}; }

  explicit ParameterReader(const ros::NodeHandle& node_handle) : node_handle_(node_handle) {}

  /// Leaves `value` alone when the parameter is not set. Throws std::invalid_argument naming the parameter and the
  /// expected type when it is set to something else.
  void read(const std::string& name, double* value);
  void read(const std::string& name, int* value);
  void read(const std::string& name, bool* value);
  void read(const std::string& name, std::string* value);
  void read(const std::string& name, std::vector<double>* value);
  void read(const std::string& name, std::vector<XmlRpc::XmlRpcValue>* value);  ///< a list of anything

  /// Full names of parameters of the namespace that are set but were never read: misspelt ones.
  std::vector<std::string> unknownParameters() const;
  void warnOfUnknown() const;  ///< a line in the log for each

  /// Full names of parameters that were read and are not set, or set to something else than their default.
  const std::set<std::string>& unsetParameters() const { return unset_; }
  const std::set<std::string>& changedParameters() const { return changed_; }

 private:
  template <typename T>
  void readAs(const std::string& name, const char* type, T* value);

  ros::NodeHandle node_handle_;
  std::set<std::string> known_;
  std::set<std::string> unset_;
  std::set<std::string> changed_;
};

}  // namespace lstm_planner
