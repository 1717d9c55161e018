#pragma once

#include <ros/node_handle.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"

namespace lstm_planner {

/// A place with a name, such as a waypoint of a list.
struct NamedPose {
  std::string name;
  Pose2 pose;
};

/// A pose (m, m, rad) from a list [x, y, yaw], a string "x y yaw" or a struct {x: , y: , yaw: }; the yaw may be left
/// out. Throws std::invalid_argument that calls the value by `name`.
Pose2 poseFromParameter(const XmlRpc::XmlRpcValue& value, const std::string& name);

/// Reads the parameters of one namespace into variables that hold their defaults.
class ParameterReader {
 public:
  explicit ParameterReader(const ros::NodeHandle& node_handle) : node_handle_(node_handle) {}

  /// Reads what it is called with, and throws as RangeCheck; see parameter_visitors.hpp. Not longer than the reader
  /// lives. `prefix`: of the names in a refusal of RangeCheck.
  auto visitor(const std::string& prefix = "") {
    return [this, prefix](const std::string& name, auto& value, Range range, const char* unit, const char* meaning) {
      read(name, &value);
      RangeCheck{prefix}(name, value, range, unit, meaning);
    };
  }

  /// Leaves `value` alone when the parameter is not set. Whatever can be meant is accepted: 1 for a number, 30.0 or a
  /// list for a text. Throws std::invalid_argument naming the parameter, its value and what was expected.
  void read(const std::string& name, double* value);
  void read(const std::string& name, int* value);
  void read(const std::string& name, bool* value);
  void read(const std::string& name, std::string* value);  ///< a number or a list as its text
  void read(const std::string& name, std::vector<double>* value);
  void read(const std::string& name, std::uint64_t* seed);  ///< a whole number
  void read(const std::string& name, Pose2* pose);          ///< see poseFromParameter()
  /// A list of poses; a struct may have a `name`, which else is its number.
  void read(const std::string& name, std::vector<NamedPose>* poses);

  /// Like read(), it makes the name known.
  bool isSet(const std::string& name);
  /// A parameter of the namespace that is read elsewhere: nobody is warned of it.
  void know(const std::string& name);
  void knowGroup(const std::string& name);  ///< all that are called NAME/...
  /// A robot's file (config/robots) is for move_base, the controller and the simulation, too: their groups are known.
  void knowRobotFile();

  /// Full names of parameters of the namespace that are set but were never read: misspelt ones.
  std::vector<std::string> unknownParameters() const;
  /// A sentence for each of them, with the nearest name that there is.
  std::vector<std::string> warningsOfUnknown() const;
  void warnOfUnknown() const;  ///< those in the log

 private:
  template <typename T, typename Convert>
  void readAs(const std::string& name, const char* type, const Convert& convert, T* value);

  ros::NodeHandle node_handle_;
  std::set<std::string> known_;
};

}  // namespace lstm_planner
