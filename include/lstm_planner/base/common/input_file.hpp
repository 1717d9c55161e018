#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace lstm_planner {

/// Why a file cannot be read; what() is the end of a sentence that starts with "PATH cannot be read: ".
class InputFileError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

// Every file that is read goes through one of these: a pipe or a device may never end, and a large file may not fit
// into the memory.

/// For those that another library opens. Throws InputFileError unless there is a regular file of at most `largest`
/// bytes.
void checkInputFile(const std::string& path, std::uintmax_t largest);

/// The whole file. Throws InputFileError as checkInputFile(), and when it cannot be read.
std::string readInputFile(const std::string& path, std::uintmax_t largest);

}  // namespace lstm_planner
