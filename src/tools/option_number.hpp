#pragma once

#include <string>

#include "lstm_planner/common/range.hpp"

namespace lstm_planner {

/// The number (int, long, unsigned long or double) that the text is. Throws std::invalid_argument
/// "NAME is TEXT, expected a number in [LEAST, MOST]" for another text and beyond the range.
template <typename Number>
Number numberOf(const std::string& name, const std::string& text, Range range);

/// "[0, 1]"
std::string toText(Range range);

/// As people write it: 0.8, 1000000.
std::string toText(double number);

}  // namespace lstm_planner
