#include <cstring>
#include <exception>
#include <iostream>

#include "tools/command.hpp"

namespace {

constexpr lstm_planner::Command kCommands[] = {
    {"drive", "drive a simulated Create 2 to random goals and judge it", lstm_planner::runDrive},
    {"train", "train a network by imitation in generated floor plans", lstm_planner::runTrain},
    {"evaluate", "judge an agent in scenarios of grid maps", lstm_planner::runEvaluate},
    {"maps", "generate floor plans as map_server maps", lstm_planner::runMaps},
};

void printUsage(std::ostream& out) {
  out << "usage: lstm_planner COMMAND [OPTION]...\n\n";
  for (const auto& command : kCommands) {
    out << "  " << command.name << "\t" << command.summary << "\n";
  }
  out << "\nlstm_planner COMMAND --help explains a command.\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || std::strcmp(argv[1], "--help") == 0) {
    printUsage(argc < 2 ? std::cerr : std::cout);
    return argc < 2 ? 2 : 0;
  }
  for (const auto& command : kCommands) {
    if (std::strcmp(argv[1], command.name) == 0) {
      try {
        return command.run({argv + 2, argv + argc});
      } catch (const std::exception& error) {
        std::cerr << "lstm_planner " << command.name << ": " << error.what() << "\n";
        return 2;
      }
    }
  }
  std::cerr << "lstm_planner: there is no command '" << argv[1] << "'\n";
  printUsage(std::cerr);
  return 2;
}
