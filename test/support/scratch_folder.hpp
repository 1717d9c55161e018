#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "lstm_planner/common/scratch_folder.hpp"

namespace lstm_planner::test {

/// A folder that writes and reads files.
class ScratchFolder : public lstm_planner::ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name = "lstm_planner") : lstm_planner::ScratchFolder(name) {}

  /// Writes a new file, with the folders above it; returns its path.
  std::string write(const std::string& name, const std::string& content) const {
    const std::filesystem::path path = this->path() / name;
    std::filesystem::create_directories(path.parent_path());
    // A file that is truncated and written again is flushed to the disk by some file systems, a new one is not.
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary) << content;
    return path.string();
  }

  std::string read(const std::string& name) const {
    std::ifstream file(path() / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }
};

}  // namespace lstm_planner::test
