#include "tools/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "lstm_planner/common/output_file.hpp"

namespace lstm_planner {

void checkWithoutExtension(const std::string& path, const std::vector<std::string>& endings) {
  const std::string extension = std::filesystem::path(path).extension().string();
  for (const std::string& ending : endings) {
    if (extension == ending) {
      throw std::invalid_argument("--output is '" + path + "', expected a path without " + ending + ", which is added");
    }
    checkWritable(path + ending);
  }
}

void makeOutputFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw std::invalid_argument("cannot make folder '" + path + "': " + error.message());
  if (::access(path.c_str(), W_OK | X_OK) != 0) {
    throw std::invalid_argument("cannot write into folder '" + path + "': " + std::strerror(errno));
  }
}

void writeTextFile(const std::string& path, const std::string& text) {
  writeOutputFile("file", path, [&](std::ostream& file) { file << text; });
}

void writeJsonFile(const std::string& path, const nlohmann::json& json) {
  writeTextFile(path, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace lstm_planner
