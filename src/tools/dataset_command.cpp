#include "tools/command.hpp"
#include "tools/dataset_commands.hpp"

namespace lstm_planner {

namespace {

/// In the order of --help.
const std::vector<Command>& datasetActions() {
  static const std::vector<Command> all = {
      {"info", "print what a dataset contains, and draw it", datasetInfo},
      {"check", "check a dataset for errors", datasetCheck},
      {"merge", "join several datasets", datasetMerge},
      {"split", "divide a dataset into a training set and a validation set", datasetSplit},
      {"export", "write a dataset as CSV or for NumPy", datasetExport},
      {"from-bag", "make a dataset from bags", datasetFromBag},
      {"from-log", "make a dataset from CARMEN logs", datasetFromLog},
      {"simulate", "let a program drive a simulated robot, and record it", datasetSimulate},
  };
  return all;
}

}  // namespace

int runDataset(const std::vector<std::string>& arguments) { return runAction("dataset", datasetActions(), arguments); }

}  // namespace lstm_planner
