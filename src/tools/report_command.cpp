#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/grid_world/evaluation/grid_report.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/grid_options.hpp"
#include "tools/output_file.hpp"
#include "tools/report_files.hpp"

namespace lstm_planner {

namespace {

struct ReportOptions {
  GridOptions grid;
  std::string output;
  std::vector<std::string> agents;
};

bool readOptions(const std::vector<std::string>& arguments, ReportOptions* options) {
  CommandLine line("report",
                   "compares agents in the same scenarios, and with the thesis's tables and figures; report --thesis "
                   "--help: the thesis's own protocol; report --memory-task --help: how long its networks remember; "
                   "report --q-table --help: Q-learning with a table");
  line.addFolder("output", &options->output, "folder for report.md, CSV files and pictures").required();
  line.add("agents", &options->agents,
           "agents: NAME or NAME=MODEL, each with ,no-shield or ,no-escape after it if you want; NAME is astar, dstar, "
           "rolling_escape, greedy, boundary, lstm, rnn, mlp, qlearning or network; without =MODEL the "
           "network of the package is used; the pictures show the first agent that does not search")
      .required();
  addGridOptions(&options->grid, &line);
  return line.parse(arguments);
}

std::string rulesText(const GridOptions& options) {
  const GridEpisodeRules& rules = options.evaluation.rules;
  const ScenarioSelection& selection = options.selection;
  std::ostringstream text;
  text << "Scenarios of " << nameOf(selection.maps, kMapSelections) << " maps with paths of "
       << (std::isfinite(selection.max_length) ? "" : "at least ") << selection.min_length;
  if (std::isfinite(selection.max_length)) text << " to " << selection.max_length;
  text << " cells, drawn with seed " << selection.seed << "; "
       << (rules.max_steps > 0 ? std::to_string(rules.max_steps) : "unlimited") << " steps, corner cutting "
       << (rules.corner_cutting == CornerCutting::kAllowed ? "allowed" : "forbidden")
       << ", arrival within one cell. Averages are over the arrivals. Times are processor times and depend on the "
          "machine. The thesis's rows are as printed: 50 scenarios of at most 300 steps, corner cutting allowed.";
  return text.str();
}

/// Where the first set has training maps.
std::optional<GridTaskSet> trainingTasks(const GridOptions& options) {
  ScenarioSelection selection = options.selection;
  selection.maps = MapSelection::kTrain;
  constexpr std::size_t kCandidates = 15;
  selection.count = kCandidates;
  const GridSetFiles files = findGridSets(options.folders.front()).front();
  if (selectMaps(files, MapSelection::kTrain).empty()) return std::nullopt;
  return drawTasksOfSet(files, selection, options.evaluation);
}

}  // namespace

int runReport(const std::vector<std::string>& arguments) {
  if (contains(arguments, "--thesis")) return runThesisReport(arguments);
  if (contains(arguments, "--memory-task")) return runMemoryReport(arguments);
  if (contains(arguments, "--q-table")) return runQTableReport(arguments);
  ReportOptions options;
  if (!readOptions(arguments, &options)) return 0;
  makeOutputFolder(options.output);
  GridComparison comparison;
  comparison.agents = agentsFromTexts(options.agents, options.grid.agent);
  comparison.rules = options.grid.evaluation.rules;
  comparison.sets = drawGridTaskSets(options.grid);
  evaluateAll(options.grid.evaluation, &comparison);

  std::ostringstream report;
  report << "# Agents of the grid world\n\n" << rulesText(options.grid) << "\n\n";
  const std::string tables = reportTables(comparison);
  report << tables;
  std::cout << tables << std::flush;
  writeTextFile(options.output + "/tables.csv", reportCsv(comparison));
  writeFigures(comparison, trainingTasks(options.grid), options.grid.evaluation, options.output, report);
  writeTextFile(options.output + "/report.md", report.str());
  std::cout << "wrote " << options.output << "/report.md\n";
  return 0;
}

}  // namespace lstm_planner
