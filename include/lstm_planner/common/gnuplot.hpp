#pragma once

#include <functional>
#include <string>

namespace lstm_planner {

/// A text in quotes for a gnuplot script.
std::string quotedForGnuplot(const std::string& text);

/// The CSV file with the numbers of a picture, beside it: "curve.csv" of "curve.png".
std::string csvPathBeside(const std::string& png_path);

/// Draws a picture with gnuplot. `script_for` returns the script for the path of the picture, on one line. Throws
/// std::runtime_error naming `what`, the content of the picture, and `csv_path`, which holds the numbers, if gnuplot is
/// missing or fails.
void runGnuplot(const std::string& what, const std::string& png_path, const std::string& csv_path,
                const std::function<std::string(const std::string& path)>& script_for);

}  // namespace lstm_planner
