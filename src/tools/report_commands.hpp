#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

// What `report` does when it is told which report; each takes the other arguments and returns the exit status.

/// `report --memory-task`: how long recurrent networks remember.
int runMemoryReport(const std::vector<std::string>& arguments);

/// `report --q-table`: tabular Q-learning on small maps, beside networks.
int runQTableReport(const std::vector<std::string>& arguments);

/// `report --thesis`: trains the thesis's networks by its rules and judges them by its rules.
int runThesisReport(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
