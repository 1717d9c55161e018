#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

// The actions of `lstm_planner dataset`: each takes the arguments behind its name and returns the exit status.

int datasetInfo(const std::vector<std::string>& arguments);
int datasetCheck(const std::vector<std::string>& arguments);
int datasetMerge(const std::vector<std::string>& arguments);
int datasetSplit(const std::vector<std::string>& arguments);
int datasetExport(const std::vector<std::string>& arguments);
int datasetFromBag(const std::vector<std::string>& arguments);
int datasetFromLog(const std::vector<std::string>& arguments);
int datasetSimulate(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
