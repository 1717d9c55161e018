#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lstm_planner {

/// The smallest value that is not exceeded by at least `share` (in [0, 1]) of the values (nearest rank); NaN if there
/// are no values.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto place = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

}  // namespace lstm_planner
