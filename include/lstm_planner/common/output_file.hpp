#pragma once

#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

namespace lstm_planner {

/// A file that cannot be written. what() is the end of a sentence that starts with "PATH cannot be written: ".
class OutputFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file that appears complete or not at all, also after a power failure: it is written under another name in
/// the same folder, synced to the disk and renamed. If the path is not a regular file (such as /dev/stdout), it is
/// written directly, and /dev/stdout through std::cout: a file to which the shell has sent it is not replaced.
class OutputFile {
 public:
  enum class Existing { kReplace, kRefuse };

  explicit OutputFile(const std::string& path, Existing existing = Existing::kReplace);
  /// Removes what was written if commit() was not called.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// The file to write to until commit(), for libraries that open files themselves.
  const std::string& partPath() const { return part_path_; }
  /// The same file as a stream. Throws OutputFileError if it cannot be opened.
  std::ostream& stream();

  /// Throws OutputFileError if something could not be written, or if there is a file that must not be replaced.
  void commit();

 private:
  void sync(const std::string& path) const;
  void rename();

  std::string path_;
  Existing existing_;
  std::ostream* standard_;  ///< of the process, if it is its name; else none
  bool is_direct_ = false;
  std::string part_path_;
  std::string journal_path_;
  std::ofstream stream_;
};

/// Throws std::invalid_argument unless the file can be written; its contents stay. Asked before a long run.
void checkWritable(const std::string& path);

/// Calls `write` to write a file. Throws std::runtime_error "WHAT 'PATH' cannot be written: REASON".
void writeOutputFile(const std::string& what, const std::string& path,
                     const std::function<void(std::ostream& file)>& write);

/// Removes all part files that were not committed; for handlers of signals that end the process.
void removeUnfinishedFiles();

}  // namespace lstm_planner
