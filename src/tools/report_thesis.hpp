#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

/// `report --thesis`: trains the thesis's networks by its rules and judges them by its rules.
int runThesisReport(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
