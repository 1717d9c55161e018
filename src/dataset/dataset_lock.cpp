#include "dataset/dataset_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

namespace {

/// Whether the path still leads to the open file: its last holder may have unlinked it in between.
bool isStillThere(const std::string& path, int descriptor) {
  struct stat by_path {};
  struct stat by_descriptor {};
  return ::stat(path.c_str(), &by_path) == 0 && ::fstat(descriptor, &by_descriptor) == 0 &&
         by_path.st_ino == by_descriptor.st_ino && by_path.st_dev == by_descriptor.st_dev;
}

}  // namespace

DatasetLock::DatasetLock(const std::string& path) : lock_path_(path + ".lock") {
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    descriptor_ = ::open(lock_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
      throw DatasetError("dataset '" + path + "' cannot be written: '" + lock_path_ + "': " + std::strerror(errno));
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) {
      if (isStillThere(lock_path_, descriptor_)) return;
    } else if (errno == EWOULDBLOCK) {
      ::close(descriptor_);
      throw DatasetError("dataset '" + path + "' is being recorded by another writer");
    } else {
      const int reason = errno;
      ::close(descriptor_);
      throw DatasetError("dataset '" + path + "' cannot be locked: '" + lock_path_ + "': " + std::strerror(reason));
    }
    ::close(descriptor_);
  }
  throw DatasetError("dataset '" + path + "' cannot be locked: '" + lock_path_ + "' comes and goes");
}

DatasetLock::~DatasetLock() {
  ::unlink(lock_path_.c_str());
  ::close(descriptor_);
}

}  // namespace lstm_planner
