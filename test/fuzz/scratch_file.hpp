#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "fuzz/harness.hpp"
#include "lstm_planner/common/scratch_folder.hpp"

namespace lstm_planner::fuzz {

/// A file in memory that is written anew for each input: readers are tested through the functions that open files.
class ScratchFile {
 public:
  /// `suffix`: of the file's name, e.g. ".yaml".
  explicit ScratchFile(const std::string& suffix = "")
      : folder_("lstm_planner_fuzz", parent()), path_(folder_ / ("input" + suffix)) {
    descriptor_ = ::open(path_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    require(descriptor_ >= 0, "a scratch file can be created");
  }
  ~ScratchFile() { ::close(descriptor_); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  void write(const void* data, std::size_t size) {
    // In this order the file keeps its pages.
    const bool written = ::pwrite(descriptor_, data, size, 0) == static_cast<ssize_t>(size) &&
                         ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0;
    require(written, "a scratch file can be written");
  }
  void write(const std::string& text) { write(text.data(), text.size()); }

  const std::string& path() const { return path_; }

 private:
  static std::filesystem::path parent() {
    const bool in_memory = ::access("/dev/shm", W_OK) == 0;
    return in_memory ? "/dev/shm" : std::filesystem::temp_directory_path();
  }

  const ScratchFolder folder_;
  const std::string path_;
  int descriptor_ = -1;
};

}  // namespace lstm_planner::fuzz
