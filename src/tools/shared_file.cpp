#include "tools/shared_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
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

}  // namespace lstm_planner
