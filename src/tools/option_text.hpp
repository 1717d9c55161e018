#pragma once

#include <cstddef>
#include <string>

#include "lstm_planner/common/range.hpp"

namespace lstm_planner {

/// "[0, 1]"
std::string toText(Range range);

/// As people write it: 0.8, 1000000.
std::string toText(double number);

constexpr std::size_t kTextWidth = 110;  ///< letters of a line, of what the tool explains

/// The text in lines of at most `width` letters, broken at blanks; all lines but the first start with `indent` blanks,
/// of which the first has `used` letters before it already.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent, std::size_t used);

}  // namespace lstm_planner
