#include "tools/command.hpp"
#include "tools/dataset_commands.hpp"

namespace lstm_planner {

namespace {

/// In the order of --help.
const std::vector<Command>& actions() {
  static const std::vector<Command> all = {
      {"info", "say what a dataset holds, and draw it", datasetInfo},
      {"check", "look for what is wrong with a dataset", datasetCheck},
      {"merge", "put several datasets into one", datasetMerge},
      {"split", "divide a dataset into one to train and one to validate", datasetSplit},
      {"export", "write a dataset as CSV or for NumPy", datasetExport},
      {"from-bag", "make a dataset of bags", datasetFromBag},
      {"from-log", "make a dataset of CARMEN logs", datasetFromLog},
      {"simulate", "record somebody who drives a simulated robot", datasetSimulate},
  };
  return all;
}

}  // namespace

int runDataset(const std::vector<std::string>& arguments) { return runAction("dataset", actions(), arguments); }

}  // namespace lstm_planner
