#include "lstm_planner/common/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <system_error>

namespace lstm_planner {

namespace {

namespace fs = std::filesystem;

/// Names that a signal handler may read at any time.
std::array<std::atomic<const char*>, 32> unfinished{};

void remember(const std::string& path) {
  for (auto& entry : unfinished) {
    const char* free = nullptr;
    if (entry.compare_exchange_strong(free, path.c_str())) return;
  }
}

void forget(const std::string& path) {
  for (auto& entry : unfinished) {
    const char* name = path.c_str();
    entry.compare_exchange_strong(name, nullptr);
  }
}

[[noreturn]] void failWith(int reason) { throw OutputFileError(std::strerror(reason)); }

/// Why no more can be written to a file: a stream does not say.
int reasonOf(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int reason = ::write(descriptor, "", 1) == 1 ? EIO : errno;
  ::close(descriptor);
  return reason;
}

/// Where a link leads, be there a file yet or not: it is to stay one.
std::string targetOf(const std::string& path) {
  std::error_code unknown;
  const fs::path target = fs::canonical(path, unknown);
  if (!unknown) return target.string();
  if (unknown != std::errc::no_such_file_or_directory) return path;  // links in a ring lead nowhere
  const fs::path next = fs::read_symlink(path, unknown);
  return unknown ? path : targetOf((fs::path(path).parent_path() / next).string());
}

bool isSpecial(const std::string& path) {
  std::error_code unknown;
  return fs::exists(path, unknown) && !fs::is_regular_file(path, unknown) && !fs::is_directory(path, unknown);
}

/// Opened by its name, what the shell has put there would be written from the start again, over all else that is
/// printed.
std::ostream* standardStream(const std::string& path) {
  if (path == "/dev/stdout") return &std::cout;
  return path == "/dev/stderr" ? &std::cerr : nullptr;
}

std::string folderOf(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

}  // namespace

OutputFile::OutputFile(const std::string& path, Existing existing)
    : path_(targetOf(path)), existing_(existing), standard_(standardStream(path)) {
  is_direct_ = isSpecial(path) || standard_ != nullptr;
  static std::atomic<int> count{0};
  part_path_ = is_direct_ ? path : path_ + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(++count);
  journal_path_ = part_path_ + "-journal";  // SQLite's
  if (is_direct_) return;
  remember(part_path_);
  remember(journal_path_);
}

OutputFile::~OutputFile() {
  if (is_direct_) return;
  stream_.close();
  ::unlink(part_path_.c_str());
  ::unlink(journal_path_.c_str());
  forget(part_path_);
  forget(journal_path_);
}

std::ostream& OutputFile::stream() {
  if (standard_ != nullptr) return *standard_;
  if (stream_.is_open()) return stream_;
  stream_.open(part_path_, std::ios::binary | std::ios::trunc);
  if (!stream_) failWith(errno);
  return stream_;
}

void OutputFile::commit() {
  if (standard_ != nullptr && !standard_->flush()) failWith(EIO);
  if (stream_.is_open()) {
    stream_.close();
    if (!stream_) failWith(reasonOf(part_path_));
  }
  if (is_direct_) return;
  sync(part_path_);
  rename();
  sync(folderOf(path_));
}

void OutputFile::sync(const std::string& path) const {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) failWith(errno);
  // Some file systems cannot sync folders.
  const int reason = ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  ::close(descriptor);
  if (reason != 0) failWith(reason);
}

void OutputFile::rename() {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (existing_ == Existing::kReplace) {
    if (fs::is_regular_file(status)) fs::permissions(part_path_, status.permissions(), error);
    fs::rename(part_path_, path_, error);
    if (error) throw OutputFileError(error.message());
    return;
  }
  // Unlike a renaming, a link does not replace what somebody has put there meanwhile.
  if (::link(part_path_.c_str(), path_.c_str()) == 0) return;
  if (errno == EEXIST || fs::exists(status)) throw OutputFileError("there is such a file already");
  fs::rename(part_path_, path_, error);  // on file systems without links, as on most USB sticks
  if (error) throw OutputFileError(error.message());
}

void checkWritable(const std::string& path) {
  try {
    const fs::file_status status = fs::status(path);
    if (fs::is_directory(status)) throw OutputFileError("it is a folder");
    // Whoever reads a pipe takes its closing for the end, and nobody would read what is written later.
    if (fs::is_fifo(status)) return;
    OutputFile(path).stream();
  } catch (const OutputFileError& error) {
    throw std::invalid_argument("cannot write '" + path + "': " + error.what());
  }
}

void writeOutputFile(const std::string& what, const std::string& path,
                     const std::function<void(std::ostream& file)>& write) {
  try {
    OutputFile file(path);
    write(file.stream());
    file.commit();
  } catch (const OutputFileError& error) {
    throw std::runtime_error(what + " '" + path + "' cannot be written: " + error.what());
  }
}

void removeUnfinishedFiles() {
  for (const auto& entry : unfinished) {
    if (const char* path = entry.load()) ::unlink(path);
  }
}

}  // namespace lstm_planner
