#include <algorithm>
#include <chrono>
#include <csignal>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "tools/command.hpp"
#include "tools/ranks.hpp"

namespace lstm_planner {
namespace {

const std::vector<Command>& commands() {
  static const std::vector<Command> all = {
      {"drive", "drive a simulated robot to random goals and judge it", runDrive},
      {"judge", "judge a network of the robot in many short drives", runJudge},
      {"train", "train a network for the robot or for the grid world", runTrain, true},
      {"evaluate", "judge an agent in scenarios of grid maps", runEvaluate, true},
      {"report", "compare agents with each other and with the thesis", runReport, true},
      {"maps", "generate floor plans, or maps and scenarios of the grid world", runMaps},
      {"model", "look at a model file, check it, or add the metadata to one that was exported elsewhere", runModel},
      {"dataset", "look at, check, merge, split and export recorded drives", runDataset},
      {"parameters", "print the parameters of plugins and nodes, with ranges and meanings", runParameters},
  };
  return all;
}

/// What went wrong on one rank has mostly gone wrong on all. The first says so, and ends the others before they do:
/// they leave it time for that, also on a machine that is busy.
int fail(const std::string& sentence) {
  const Communicator& all = *ranks();
  if (!isFirstRank()) std::this_thread::sleep_for(std::chrono::seconds(10));
  const std::string rank =
      isFirstRank() ? "" : " (rank " + std::to_string(all.rank()) + " of " + std::to_string(all.size()) + ")";
  std::cerr << "lstm_planner" + sentence + rank + "\n";  // at once, or a launcher puts its own lines in between
  if (all.size() > 1) endAllRanks(2);
  return 2;
}

/// Nothing is left of what was being written.
void endBySignal(int signal) {
  removeUnfinishedFiles();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

int run(const Command& command, const std::vector<std::string>& arguments) {
  if (!command.shared) requireOneRank("this command");
  if (!isFirstRank()) std::cout.rdbuf(nullptr);
  const int status = command.run(arguments);
  if (isFirstRank() && !std::cout.flush())
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
    const lstm_planner::MpiSession session(&argc, &argv);
    return lstm_planner::runTool({argv + std::min(argc, 1), argv + argc});
  } catch (const std::exception& error) {
    return lstm_planner::fail(std::string(": ") + error.what());
  }
}
