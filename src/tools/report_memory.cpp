#include <iostream>
#include <sstream>

#include "lstm_planner/training/memory_comparison.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"

namespace lstm_planner {

namespace {

struct MemoryOptions {
  std::string output;
  MemoryComparisonParameters comparison;
};

bool readOptions(const std::vector<std::string>& arguments, MemoryOptions* options) {
  MemoryComparisonParameters& comparison = options->comparison;
  bool memory = true;
  CommandLine line("report --memory-task",
                   "how long plain recurrent networks and LSTMs remember, and how their gradients vanish (thesis 2.2, "
                   "Eq. 2.20, Figures 2.6 and 2.9)");
  line.addFlag("memory-task", &memory, true, "this");
  line.addFolder("output", &options->output, "folder for memory.md, CSV files and pictures").required();
  line.add("delays", &comparison.delays, {1, 1e4}, "steps between the symbol and the answer");
  line.add("shown-delay", &comparison.shown_delay, {1, 1e4}, "the delay of --delays whose networks are drawn");
  line.add("sequences", &comparison.sequences, {1, 1e6}, "sequences to learn from, and as many to judge by");
  line.add("epochs", &comparison.epochs, kAnyCount, "epochs of each training");
  line.add("rate", &comparison.learning_rate, kAnyRate, "learning rate");
  line.add("seeds", &comparison.seeds, {1, 1000}, "number of trainings of each network");
  line.addSeed(&comparison.seed, "seed of the first training");
  line.add("threads", &comparison.threads, kAnyThreads, "number of threads; does not change the result");
  if (!line.parse(arguments)) return false;
  validate(comparison);
  return true;
}

}  // namespace

int runMemoryReport(const std::vector<std::string>& arguments) {
  MemoryOptions options;
  if (!readOptions(arguments, &options)) return 0;
  makeOutputFolder(options.output);
  const MemoryComparisonParameters& comparison = options.comparison;
  const Interruption interruption;
  Progress bar;
  const std::vector<MemoryOutcome> outcomes = compareMemory(comparison, memoryNetworks(), [&](double share) {
    bar.show(share);
    return !interruption.wanted();
  });
  if (outcomes.empty()) {
    std::cout << "interrupted: no network is complete, nothing is written" << std::endl;
    return interruption.exitStatus();
  }
  std::ostringstream report;
  report << "# Memory\n\n"
         << comparison.sequences << " sequences, " << comparison.epochs << " epochs, learning rate "
         << comparison.learning_rate << "; " << comparison.seeds << " seeds from " << comparison.seed
         << " on: the mean, in brackets the lowest and the highest. Chance is 50 %.\n\n"
         << memoryTables(comparison, outcomes);
  std::cout << report.str();
  writeTextFile(options.output + "/memory.md", report.str());
  writeMemoryFigures(options.output, outcomes);
  std::cout << "wrote " << options.output << "/memory.md" << std::endl;
  if (!interruption.wanted()) return 0;
  std::cout << "interrupted: " << outcomes.size() << " networks are complete" << std::endl;
  return interruption.exitStatus();
}

}  // namespace lstm_planner
