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

void printUsage(std::ostream& out) {
  out << "usage: lstm_planner dataset ACTION [OPTION]...\n\n";
  for (const Command& action : actions()) out << "  " << action.name << "\t" << action.summary << "\n";
  out << "\nlstm_planner dataset ACTION --help explains an action.\n";
}

std::string namesOfActions() {
  std::string names;
  for (const Command& action : actions()) names += (names.empty() ? "" : ", ") + std::string(action.name);
  return names;
}

}  // namespace

int runDataset(const std::vector<std::string>& arguments) {
  if (!arguments.empty() && arguments[0] == "--help") {
    printUsage(std::cout);
    return 0;
  }
  if (arguments.empty()) throw std::invalid_argument("an action is missing, expected one of " + namesOfActions());
  for (const Command& action : actions()) {
    if (arguments[0] == action.name) return action.run({arguments.begin() + 1, arguments.end()});
  }
  throw std::invalid_argument("there is no action '" + arguments[0] + "', expected one of " + namesOfActions());
}

}  // namespace lstm_planner
