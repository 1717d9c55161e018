#pragma once

#include <yaml-cpp/node/node.h>

#include <string>

namespace lstm_planner {

/// A yaml file that a user names: the NAME of a `folder`/NAME.yaml that comes with the package (findSharedFile()), or a
/// path.
struct ShippedYaml {
  std::string path;
  YAML::Node root;  ///< a map
};

/// Throws std::invalid_argument with a sentence: there is no such `what`, such as robot; or the file cannot be read, or
/// is no map, where `expected` says what a map of it holds.
ShippedYaml readShippedYaml(const std::string& what, const std::string& folder, const std::string& name,
                            const std::string& expected);

}  // namespace lstm_planner
