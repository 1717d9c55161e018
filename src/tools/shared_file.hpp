#pragma once

#include <yaml-cpp/node/node.h>

#include <string>

namespace lstm_planner {

/// Path of a file that comes with the package, such as `models/grid_lstm_2x8.onnx`, from whatever folder the tool is
/// run: in the current folder, in the share folder of the install space, in the sources of the tool's own devel space,
/// or in a package on ROS_PACKAGE_PATH, whichever comes first. The name itself where there is none, so that the
/// reader's message names it.
std::string findSharedFile(const std::string& name);

/// A yaml file that a user names: the NAME of a `folder`/NAME.yaml that comes with the package (findSharedFile()), or a
/// path.
struct ShippedYaml {
  std::string path;
  YAML::Node root;  ///< a map
};

/// Throws std::invalid_argument with a sentence: there is no such `what`, such as robot; or the file cannot be read, or
/// is no single map, where `expected` says what a map of it holds.
ShippedYaml readShippedYaml(const std::string& what, const std::string& folder, const std::string& name,
                            const std::string& expected);

/// The text of a map's key. Throws std::invalid_argument with the line in the file where it is none.
std::string keyOf(const std::string& path, const YAML::Node& key);

}  // namespace lstm_planner
