#pragma once

#include <string>

namespace lstm_planner {

/// Keeps a second writer off a dataset file as long as it lives, by a lock on a file PATH.lock beside it. A lock on the
/// file itself would not do: SQLite's own locks are of the kind that the process loses when it closes any descriptor of
/// the file. A process that dies leaves an unlocked PATH.lock, which disturbs nobody.
class DatasetLock {
 public:
  /// Throws DatasetError when another process, or another writer of this one, has it.
  explicit DatasetLock(const std::string& path);
  ~DatasetLock();
  DatasetLock(const DatasetLock&) = delete;
  DatasetLock& operator=(const DatasetLock&) = delete;

 private:
  std::string lock_path_;
  int descriptor_ = -1;
};

}  // namespace lstm_planner
