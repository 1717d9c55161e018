#pragma once

#include <string>

namespace lstm_planner {

/// As sha1sum prints it; "unreadable" where the file cannot be read.
std::string sha1OfFile(const std::string& path);

}  // namespace lstm_planner
