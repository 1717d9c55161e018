#include <iostream>
#include <stdexcept>

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

std::string namesOfActions() {
  std::string names;
  for (const Command& action : actions()) names += (names.empty() ? "" : ", ") + std::string(action.name);
  return names;
}

}  // namespace

int runDataset(const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw std::invalid_argument("an action is missing, expected one of " + namesOfActions());
  if (arguments[0] == "--help" || arguments[0] == "-h") {
    printUsage("lstm_planner dataset", "ACTION", actions(), std::cout);
    return 0;
  }
  return commandNamed(arguments[0], "action", actions()).run({arguments.begin() + 1, arguments.end()});
}

}  // namespace lstm_planner
