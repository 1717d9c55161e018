#include "tools/shared_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace lstm_planner {

std::string findSharedFile(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (fs::exists(name, ignored)) return name;
  const fs::path tool = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = tool.parent_path().parent_path() / "share" / "lstm_planner" / name;
  if (fs::exists(installed, ignored)) return installed.string();
  const char* const packages = std::getenv("ROS_PACKAGE_PATH");
  std::istringstream folders(packages == nullptr ? "" : packages);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path in_package = fs::path(folder) / "lstm_planner" / name;
    if (fs::exists(in_package, ignored)) return in_package.string();
  }
  return name;
}

}  // namespace lstm_planner
