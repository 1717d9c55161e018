#pragma once

#include <string>

namespace lstm_planner {

/// A text in quotes for a gnuplot script.
std::string quotedForGnuplot(const std::string& text);

/// The CSV file with the numbers of a picture, beside it: "curve.csv" of "curve.png".
std::string csvPathBeside(const std::string& png_path);

/// Draws a PNG picture with gnuplot. `size`: width and height in pixels, "900,800", and what else gnuplot is to know of
/// the picture itself. `script`: what is drawn, on one line. Throws std::runtime_error naming `what`, the content of
/// the picture, and `csv_path`, which holds the numbers, if gnuplot is missing or fails.
void runGnuplot(const std::string& what, const std::string& png_path, const std::string& csv_path,
                const std::string& size, const std::string& script);

}  // namespace lstm_planner
