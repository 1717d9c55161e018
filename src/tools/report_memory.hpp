#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

/// `report --memory-task`: how long recurrent networks remember. Returns the exit status.
int runMemoryReport(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
