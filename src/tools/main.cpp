#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "tools/command.hpp"

namespace lstm_planner {
namespace {

const std::vector<Command>& commands() {
  static const std::vector<Command> all = {
      {"drive", "drive a simulated robot to random goals and judge it", runDrive},
      {"judge", "judge a network of the robot in many short drives", runJudge},
      {"train", "train a network for the robot or for the grid world", runTrain},
      {"evaluate", "judge an agent in scenarios of grid maps", runEvaluate},
      {"report", "compare agents with each other and with the thesis", runReport},
      {"maps", "generate floor plans, or maps and scenarios of the grid world", runMaps},
      {"model", "look at a model file, check it, or add the metadata to one that was exported elsewhere", runModel},
      {"dataset", "look at, check, merge, split and export recorded drives", runDataset},
      {"parameters", "print the parameters of plugins and nodes, with ranges and meanings", runParameters},
  };
  return all;
}

int fail(const std::string& sentence) {
  std::cerr << "lstm_planner" << sentence << "\n";
  return 2;
}

/// Nothing is left of what was being written.
void endBySignal(int signal) {
  removeUnfinishedFiles();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

int run(const Command& command, const std::vector<std::string>& arguments) {
  const int status = command.run(arguments);
  if (!std::cout.flush())
    throw std::runtime_error("standard output cannot be written; not all that was found is there");
  return status;
}

int runTool(const std::vector<std::string>& arguments) {
  const std::string first = arguments.empty() ? "" : arguments.front();
  if (first.empty() || first == "--help" || first == "-h") {
    printUsage("lstm_planner", "COMMAND", commands(), first.empty() ? std::cerr : std::cout);
    return first.empty() ? 2 : 0;
  }
  if (first == "--version") {
    std::cout << "lstm_planner " << softwareVersion() << "\n";
    return 0;
  }
  const Command command = commandNamed(first, "command", commands());
  try {
    return run(command, {arguments.begin() + 1, arguments.end()});
  } catch (const std::exception& error) {
    return fail(std::string(" ") + command.name + ": " + error.what());
  }
}

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    if (std::signal(signal, lstm_planner::endBySignal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  try {
    return lstm_planner::runTool({argv + std::min(argc, 1), argv + argc});
  } catch (const std::exception& error) {
    return lstm_planner::fail(std::string(": ") + error.what());
  }
}
