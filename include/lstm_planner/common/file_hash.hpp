#pragma once

#include <string>

namespace lstm_planner {

/// SHA-1 of a file in hexadecimal, as sha1sum prints it; "unreadable" if the file cannot be read.
std::string sha1OfFile(const std::string& path);

}  // namespace lstm_planner
