#pragma once

#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

namespace lstm_planner {

/// Why a file cannot be written; what() is the end of a sentence that starts with "PATH cannot be written: ".
class OutputFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that appears whole or not at all, also when the power fails: written beside its place, synced to the disk and
/// renamed into it. What is no regular file, such as /dev/stdout, is written directly.
class OutputFile {
 public:
  enum class Existing { kReplace, kRefuse };

  explicit OutputFile(const std::string& path, Existing existing = Existing::kReplace);
  /// Removes what was written unless commit() was called.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Where it is written until commit(), for libraries that write files themselves.
  const std::string& partPath() const { return part_path_; }
  /// The same as a stream. Throws OutputFileError when it cannot be opened.
  std::ostream& stream();

  /// Throws OutputFileError when something could not be written, or when there is such a file that is not to be
  /// replaced.
  void commit();

 private:
  void sync(const std::string& path) const;
  void rename();

  std::string path_;
  Existing existing_;
  bool is_direct_ = false;
  std::string part_path_;
  std::string journal_path_;
  std::ofstream stream_;
};

/// Writes a file by `write`. Throws std::runtime_error "WHAT 'PATH' cannot be written: REASON".
void writeOutputFile(const std::string& what, const std::string& path,
                     const std::function<void(std::ostream& file)>& write);

/// Removes all that is being written; for handlers of signals that end the process.
void removeUnfinishedFiles();

}  // namespace lstm_planner
