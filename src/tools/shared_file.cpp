#include "tools/shared_file.hpp"

#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace lstm_planner {
namespace {

namespace fs = std::filesystem;

/// Appends the folders of a list like that of ROS_PACKAGE_PATH.
void append(const std::string& list, char separator, std::vector<fs::path>* folders) {
  std::istringstream stream(list);
  for (std::string folder; std::getline(stream, folder, separator);) {
    if (!folder.empty()) folders->emplace_back(folder);
  }
}

/// Where packages may lie: in the folders that the workspace of the tool was made of, which catkin names in the file
/// .catkin of its devel space, and in those of the environment.
std::vector<fs::path> sourceFolders(const fs::path& prefix) {
  std::vector<fs::path> folders;
  std::ifstream workspace(prefix / ".catkin");
  std::string list;
  if (std::getline(workspace, list)) append(list, ';', &folders);
  if (const char* const packages = std::getenv("ROS_PACKAGE_PATH")) append(packages, ':', &folders);
  return folders;
}

std::string pathOf(const std::string& what, const std::string& folder, const std::string& name) {
  const std::string shared = findSharedFile(folder + "/" + name + ".yaml");
  if (std::filesystem::is_regular_file(shared)) return shared;
  if (std::filesystem::is_regular_file(name)) return name;
  throw std::invalid_argument("there is no " + what + " '" + name + "', expected a yaml file, or the NAME of a " +
                              folder + "/NAME.yaml");
}

}  // namespace

std::string findSharedFile(const std::string& name) {
  std::error_code ignored;
  if (fs::exists(name, ignored)) return name;
  const fs::path prefix = fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
  std::vector<fs::path> candidates = {prefix / "share" / "lstm_planner" / name};
  for (const fs::path& folder : sourceFolders(prefix)) {
    candidates.push_back(folder / "lstm_planner" / name);
    candidates.push_back(folder / name);  // the folder is the package itself
  }
  for (const fs::path& candidate : candidates) {
    if (fs::exists(candidate, ignored)) return candidate.string();
  }
  return name;
}

ShippedYaml readShippedYaml(const std::string& what, const std::string& folder, const std::string& name,
                            const std::string& expected) {
  const std::string path = pathOf(what, folder, name);
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAllFromFile(path);
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(path + ": " + error.what() + ", expected " + expected);
  }
  if (documents.size() > 1)
    throw std::invalid_argument(path + ": a second document follows behind '---', expected one");
  if (documents.empty() || !documents[0].IsMap()) throw std::invalid_argument(path + ": expected " + expected);
  return {path, documents[0]};
}

std::string keyOf(const std::string& path, const YAML::Node& key) {
  if (key.IsScalar()) return key.Scalar();
  throw std::invalid_argument(path + ", line " + std::to_string(key.Mark().line + 1) +
                              ": a list, a map or nothing stands where a name should");
}

}  // namespace lstm_planner
