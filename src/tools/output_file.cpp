#include "tools/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "tools/ranks.hpp"

namespace lstm_planner {

void checkWritable(const std::string& path) {
  if (!isFirstRank()) return;
  std::error_code unknown;
  const bool was_there = std::filesystem::exists(path, unknown);
  const bool writable = std::ofstream(path, std::ios::app).is_open();
  const int reason = errno;
  if (!writable) throw std::invalid_argument("cannot write '" + path + "': " + std::strerror(reason));
  if (!was_there) std::filesystem::remove(path, unknown);
}

void makeOutputFolder(const std::string& path) {
  if (!isFirstRank()) return;
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw std::invalid_argument("cannot make folder '" + path + "': " + error.message());
  if (::access(path.c_str(), W_OK | X_OK) != 0) {
    throw std::invalid_argument("cannot write into folder '" + path + "': " + std::strerror(errno));
  }
}

void writeTextFile(const std::string& path, const std::string& text) {
  if (!isFirstRank()) return;
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno));
}

}  // namespace lstm_planner
