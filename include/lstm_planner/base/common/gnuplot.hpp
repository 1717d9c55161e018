#pragma once

#include <functional>
#include <string>

namespace lstm_planner {

/// A text as gnuplot reads it.
std::string quotedForGnuplot(const std::string& text);

/// Draws a picture by a script of one line: `script_for` makes it for the file that gnuplot is to write. Throws
/// std::runtime_error naming `what`, the thing to be drawn, when gnuplot is missing or fails; `csv_path` has the
/// numbers all the same.
void runGnuplot(const std::string& what, const std::string& png_path, const std::string& csv_path,
                const std::function<std::string(const std::string& path)>& script_for);

}  // namespace lstm_planner
