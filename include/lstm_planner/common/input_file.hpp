#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace lstm_planner {

/// A file that cannot be read. what() is the end of a sentence that starts with "PATH cannot be read: ".
class InputFileError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

// All files are read through one of these functions: a pipe or a device may never end, and a large file may not fit
// into memory.

/// Checks a file that another library opens. Throws InputFileError unless it is a regular file of at most `largest`
/// bytes.
void checkInputFile(const std::string& path, std::uintmax_t largest);

/// Reads a whole file. Throws InputFileError as checkInputFile(), and if the file cannot be read.
std::string readInputFile(const std::string& path, std::uintmax_t largest);

}  // namespace lstm_planner
