#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "fuzz/harness.hpp"

namespace lstm_planner::fuzz {

/// A file in memory that is written anew for each input: readers are tested through the functions that open files.
class ScratchFile {
 public:
  /// `suffix`: of the file's name, e.g. ".yaml".
  explicit ScratchFile(const std::string& suffix = "") : path_(pattern() + suffix) {
    descriptor_ = ::mkstemps(path_.data(), static_cast<int>(suffix.size()));
    require(descriptor_ >= 0, "a scratch file can be created");
  }
  ~ScratchFile() {
    ::close(descriptor_);
    ::unlink(path_.c_str());
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  void write(const void* data, std::size_t size) {
    const bool written =
        ::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, data, size, 0) == static_cast<ssize_t>(size);
    require(written, "a scratch file can be written");
  }
  void write(const std::string& text) { write(text.data(), text.size()); }

  const std::string& path() const { return path_; }

 private:
  static std::string pattern() {
    const bool in_memory = ::access("/dev/shm", W_OK) == 0;
    return (in_memory ? "/dev/shm" : std::filesystem::temp_directory_path().string()) + "/lstm_planner_fuzz_XXXXXX";
  }

  std::string path_;
  int descriptor_ = -1;
};

}  // namespace lstm_planner::fuzz
