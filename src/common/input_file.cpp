#include "lstm_planner/common/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lstm_planner {

namespace {

[[noreturn]] void fail(int reason) {
  throw InputFileError(reason == ENOENT ? "there is no such file" : std::strerror(reason));
}

std::size_t checkedSize(const struct stat& status, std::uintmax_t largest) {
  if (S_ISDIR(status.st_mode)) throw InputFileError("it is a folder, expected a file");
  if (!S_ISREG(status.st_mode)) throw InputFileError("it is a pipe or a device, expected a regular file");
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size > largest) {
    throw InputFileError("it has " + std::to_string(size) + " bytes, expected at most " + std::to_string(largest));
  }
  return static_cast<std::size_t>(size);
}

/// A file that is open for reading.
class Descriptor {
 public:
  /// Without O_NONBLOCK a pipe would wait for its writer.
  explicit Descriptor(const std::string& path) : number_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (number_ < 0) fail(errno);
  }
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  std::size_t size(std::uintmax_t largest) const {
    struct stat status {};
    if (::fstat(number_, &status) != 0) fail(errno);
    return checkedSize(status, largest);
  }

  void read(std::string* content) const {
    std::size_t done = 0;
    while (done < content->size()) {
      const ssize_t count = ::read(number_, &(*content)[done], content->size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(errno);
      if (count == 0) throw InputFileError("it ended while it was read");
      done += static_cast<std::size_t>(count);
    }
  }

 private:
  int number_;
};

}  // namespace

// Not opened here: SQLite's locks on a file are lost when the process closes any descriptor of it.
void checkInputFile(const std::string& path, std::uintmax_t largest) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) fail(errno);
  checkedSize(status, largest);
}

std::string readInputFile(const std::string& path, std::uintmax_t largest) {
  const Descriptor file(path);
  std::string content(file.size(largest), '\0');
  file.read(&content);
  return content;
}

}  // namespace lstm_planner
