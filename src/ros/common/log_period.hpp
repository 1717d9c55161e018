#pragma once

namespace lstm_planner {

/// s; what is still wrong is said again after that long.
constexpr double kLogPeriod = 2.0;

}  // namespace lstm_planner
