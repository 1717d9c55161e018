#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

/// `report --q-table`: tabular Q-learning on small maps, beside networks. Returns the exit status.
int runQTableReport(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
