#pragma once

#include <vector>

namespace lstm_planner {

/// The smallest value that is not exceeded by at least `share` (in [0, 1]) of the values (nearest rank); NaN if there
/// are no values.
double quantile(std::vector<double> values, double share);

}  // namespace lstm_planner
