#include "tools/shipped_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <stdexcept>

#include "tools/shared_file.hpp"

namespace lstm_planner {
namespace {

std::string pathOf(const std::string& what, const std::string& folder, const std::string& name) {
  const std::string shared = findSharedFile(folder + "/" + name + ".yaml");
  if (std::filesystem::is_regular_file(shared)) return shared;
  if (std::filesystem::is_regular_file(name)) return name;
  throw std::invalid_argument("there is no " + what + " '" + name + "', expected a yaml file, or the NAME of a " +
                              folder + "/NAME.yaml");
}

}  // namespace

ShippedYaml readShippedYaml(const std::string& what, const std::string& folder, const std::string& name,
                            const std::string& expected) {
  const std::string path = pathOf(what, folder, name);
  try {
    const YAML::Node root = YAML::LoadFile(path);
    if (root.IsMap()) return {path, root};
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(path + ": " + error.what());
  }
  throw std::invalid_argument(path + ": expected " + expected);
}

}  // namespace lstm_planner
