#pragma once

#include <vector>

namespace lstm_planner {

/// The value that a share in [0, 1] of the values does not exceed, by nearest rank; not a number for no values.
double quantile(std::vector<double> values, double share);

}  // namespace lstm_planner
