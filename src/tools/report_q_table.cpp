#include <iostream>
#include <sstream>

#include "lstm_planner/grid_world/evaluation/q_table_comparison.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"
#include "tools/report_files.hpp"

namespace lstm_planner {

namespace {

struct QTableOptions {
  std::string output;
  std::vector<std::string> agents = {"qlearning,no-escape", "greedy"};
  QTableComparisonParameters comparison;
};

bool readOptions(const std::vector<std::string>& arguments, QTableOptions* options) {
  QTableComparisonParameters& comparison = options->comparison;
  bool table = true;
  CommandLine line("report --q-table",
                   "tabular Q-learning (thesis Eq. 2.35) on small generated maps, beside agents that have never seen "
                   "them");
  line.addFlag("q-table", &table, true, "this");
  line.addOutput("output", &options->output, "Markdown file to write the table to");
  line.add("agents", &options->agents, "agents to compare with, in the form of report --agents");
  line.add("size", &comparison.size, {8, 512}, "cells; side of the square maps");
  line.add("maps", &comparison.maps, {1, 1000}, "maps of each kind: mazes, random fill, caves");
  line.add("starts", &comparison.starts, {1, 1e5}, "starts in each map, to judge the agents");
  line.add("episodes", &comparison.episodes, {1, 1e6},
           "numbers of episodes after which the table is judged, in rising order");
  line.add("rate", &comparison.table.learning_rate, {1e-6, 1.0}, "learning rate (alpha)");
  line.add("discount", &comparison.table.discount, {1e-6, 1.0}, "discount per step (gamma)");
  line.add("exploration", &comparison.table.exploration, {0.0, 1.0}, "share of moves at random (epsilon)");
  line.add("max-steps", &comparison.max_steps, kAnySteps, "steps of an episode at most, while learning and judging");
  line.addSeed(&comparison.seed, "seed of maps, starts and learning");
  line.add("threads", &comparison.threads, kAnyThreads, "number of threads; does not change the result");
  if (!line.parse(arguments)) return false;
  comparison.table.max_steps = comparison.max_steps;
  validate(comparison);
  return true;
}

}  // namespace

int runQTableReport(const std::vector<std::string>& arguments) {
  QTableOptions options;
  if (!readOptions(arguments, &options)) return 0;
  std::vector<std::pair<std::string, GridAgentMaker>> others;
  for (const ReportAgent& agent : agentsFromTexts(options.agents, {})) {
    others.emplace_back(agent.agent.name, agent.agent.make);
  }
  const QTableComparisonParameters& comparison = options.comparison;
  Progress bar;
  const auto outcomes = compareQTables(comparison, others, [&](double share) { bar.show(share); });
  std::ostringstream report;
  report << comparison.maps << " maps of " << comparison.size << " x " << comparison.size << " cells of each kind, "
         << comparison.starts << " starts each, " << comparison.max_steps << " steps; learning rate "
         << comparison.table.learning_rate << ", discount " << comparison.table.discount << ", exploration "
         << comparison.table.exploration << "; seed " << comparison.seed << ".\n\n"
         << toMarkdown(outcomes);
  std::cout << report.str();
  if (!options.output.empty()) writeTextFile(options.output, report.str());
  return 0;
}

}  // namespace lstm_planner
