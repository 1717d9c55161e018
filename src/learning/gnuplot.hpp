#pragma once

#include <string>

namespace lstm_planner {

/// A text as gnuplot reads it.
std::string quotedForGnuplot(const std::string& text);

/// Runs a script of one line. Throws std::runtime_error naming `what`, the thing to be drawn, when gnuplot is missing or
/// fails; `csv_path` has the numbers all the same.
void runGnuplot(const std::string& script, const std::string& what, const std::string& csv_path);

}  // namespace lstm_planner
