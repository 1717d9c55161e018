#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

/// An array as the content of a .npy file, version 1.0 of numpy.lib.format: row by row, little-endian. `Number` is
/// double, float or std::int64_t. `row_length` 0: one dimension. Throws std::invalid_argument if the last row is not
/// complete.
template <typename Number>
std::string toNpy(const std::vector<Number>& numbers, std::size_t row_length = 0);

}  // namespace lstm_planner
