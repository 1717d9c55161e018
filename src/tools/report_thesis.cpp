#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/markdown_table.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/grid_world/evaluation/grid_agent_factory.hpp"
#include "lstm_planner/grid_world/evaluation/grid_report.hpp"
#include "lstm_planner/grid_world/evaluation/thesis_maps.hpp"
#include "lstm_planner/grid_world/learning/thesis_training.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"
#include "tools/report_files.hpp"

namespace lstm_planner {

namespace {

struct ThesisOptions {
  std::vector<std::string> folders;
  std::string output;
  GridImitationParameters training = thesisTraining();
  ScenarioSelection selection;
  GridEvaluationOptions evaluation;
};

bool readOptions(const std::vector<std::string>& arguments, ThesisOptions* options) {
  ScenarioSelection& selection = options->selection;
  selection.min_length = options->training.course.min_length;
  selection.max_length = options->training.course.max_length;
  selection.count = 50;
  selection.rule = PassableRule::kThesis;
  GridEpisodeRules& rules = options->evaluation.rules;
  rules.corner_cutting = CornerCutting::kAllowed;
  rules.max_steps = 300;
  bool thesis = true;
  CommandLine line(
      "report --thesis",
      "repeats the thesis's chapter 3 with its own protocol: trains its networks on five maps (Tables 3.1 and 3.2), "
      "and tests them in ten maps of each set; without shield and escape, corners may be cut, only '.' is free");
  line.addFlag("thesis", &thesis, true, "this");
  line.addFiles("scenarios", &options->folders,
                "folders with the MovingAI benchmark's sets; for training: mazes of width 2 and 4, random fill of 25 "
                "and 40 %; for tests: Dragon Age, mazes of width 8, random fill of 25 %")
      .required();
  line.addFolder("output", &options->output, "folder for thesis.md, networks, CSV files and pictures").required();
  line.add("count", &selection.count, {1, 1e9}, "tasks of each set");
  line.add("max-steps", &rules.max_steps, {1, 1e12}, "largest number of steps of a task");
  line.add("steps", &options->training.dataset.steps, kAnySteps, "number of steps for training");
  line.add("validation-steps", &options->training.validation_steps, kAnySteps,
           "number of steps to choose the best epoch");
  line.add("epochs", &options->training.trainer.epochs, kAnyCount, "number of epochs");
  line.addSeed(&options->training.seed, "seed of maps, tasks, weights and training");
  line.add("threads", &options->training.threads, kAnyThreads, "number of threads; does not change the result");
  if (!line.parse(arguments)) return false;
  selection.seed = options->training.seed;
  options->evaluation.threads = options->training.threads;
  validate(options->training);
  return true;
}

std::vector<GridSetFiles> setsIn(const std::vector<std::string>& folders) {
  std::vector<GridSetFiles> sets;
  for (const std::string& folder : folders) {
    for (GridSetFiles& set : findGridSets(folder)) sets.push_back(std::move(set));
  }
  return sets;
}

/// A network agent as the thesis lets it walk, or with the shield.
ReportAgent networkAgent(const std::string& name, const Model& model, bool shield) {
  NetworkGridAgent::Options options;
  options.corner_cutting = CornerCutting::kAllowed;
  options.shield = shield;
  options.guided = false;
  const auto make = [model, options](const PassableGrid&) {
    return std::make_unique<NetworkGridAgent>(model, options);
  };
  return {{name, make}, false};
}

ReportAgent aStarAgent() {
  GridAgentOptions options;
  options.agent = "astar";
  options.corner_cutting = CornerCutting::kAllowed;
  options.heuristic = Heuristic::kScaledEuclidean;
  options.keep_closed = true;
  return {{"A*", gridAgentMaker(options)}, true};
}

/// A scenario file of each map.
std::vector<std::string> filesOf(const std::vector<GridMapFiles>& maps) {
  std::vector<std::string> files;
  for (const GridMapFiles& map : maps) files.push_back(map.scenario_files.front());
  return files;
}

/// Trains all networks, writes them, and appends their accuracies to the report; A* and they as agents.
std::vector<ReportAgent> trainAgents(const ThesisOptions& options, const ThesisMaps& maps, std::ostream& report) {
  const Interruption interruption;
  std::vector<ReportAgent> agents = {aStarAgent()};
  std::vector<ReportAgent> shielded;
  MarkdownTable table({"network", "weights", "training accuracy", "validation accuracy"}, &report);
  for (const ThesisNetwork& network : thesisNetworks()) {
    std::cout << "training " << network.name << std::endl;
    Progress bar;
    const auto progress = [&](double share) {
      bar.show(share);
      return !interruption.wanted();
    };
    const ThesisNetworkResult trained =
        trainThesisNetwork(network, options.training, filesOf(maps.training), filesOf(maps.validation), progress);
    if (interruption.wanted()) throw std::runtime_error("interrupted while " + network.name + " was trained");
    writeModelFile(options.output + "/" + network.file, trained.model);
    table.row({network.name, std::to_string(countWeights(trained.model.layers)),
               percentText(trained.training_accuracy, 2), percentText(trained.validation_accuracy, 2)});
    agents.push_back(networkAgent(network.name, trained.model, false));
    shielded.push_back(networkAgent(network.name + ", with shield", trained.model, true));
  }
  report << '\n';
  agents.insert(agents.end(), shielded.begin(), shielded.end());
  return agents;
}

/// Table 3.6; that the thesis's tables count A* only where the network arrived is said by its program's logs.
void appendProperties(std::ostream& report) {
  report << "## Table 3.6: properties\n\n";
  MarkdownTable table({"Property", "A*", "LSTM"}, &report);
  table.row({"Agent type", "offline", "online"});
  table.row({"Output", "a path, the same for the same map", "a preference over eight moves (softmax), step by step"});
  table.row({"Environment", "known", "unknown: eight rays of at most 50 cells"});
  table.row({"Solution", "the whole path", "one step at a time"});
  table.row({"Nodes that can be expanded", "any", "the neighbours"});
  table.row({"A node is counted when", "it is taken from the open list", "a new input is built"});
  report << '\n';
}

/// The averages of A* that the thesis prints are over the tasks that its LSTM solved.
void appendSolvedAverages(const GridComparison& comparison, std::ostream& report) {
  constexpr std::size_t kAStar = 0;
  constexpr std::size_t kLstm = 1;
  for (std::size_t set = 0; set < comparison.sets.size(); ++set) {
    double solved = 0.0;
    double length = 0.0;
    double expanded = 0.0;
    for (std::size_t task = 0; task < comparison.sets[set].tasks.size(); ++task) {
      if (comparison.episodes[set][kLstm][task].end != GridEpisode::End::kArrived) continue;
      const GridEpisode& a_star = comparison.episodes[set][kAStar][task];
      solved += 1.0;
      length += a_star.length();
      expanded += static_cast<double>(a_star.expanded);
    }
    if (solved == 0.0) continue;
    report << comparison.sets[set].name << ": over the " << fixedText(solved, 0) << " tasks that "
           << comparison.agents[kLstm].agent.name << " solved, as the thesis averages, A* has length "
           << fixedText(length / solved, 2) << " and expands " << fixedText(expanded / solved, 2) << ".\n\n";
  }
}

/// Tables 3.7-3.9 for tasks of at most `max_length` cells.
GridComparison compare(const ThesisOptions& options, const ThesisMaps& maps, const std::vector<ReportAgent>& agents,
                       double max_length) {
  GridComparison comparison;
  comparison.agents = agents;
  comparison.rules = options.evaluation.rules;
  ScenarioSelection selection = options.selection;
  selection.max_length = max_length;
  for (const GridSetFiles& set : maps.tests) comparison.sets.push_back(drawGridTasks(set, selection));
  evaluateAll(options.evaluation, &comparison);
  return comparison;
}

std::string fileNames(std::vector<std::string> files) {
  for (std::string& file : files) file.erase(0, file.rfind('/') + 1);
  return joined(files);
}

}  // namespace

int runThesisReport(const std::vector<std::string>& arguments) {
  ThesisOptions options;
  if (!readOptions(arguments, &options)) return 0;
  makeOutputFolder(options.output);
  const ThesisMaps maps = chooseThesisMaps(setsIn(options.folders), options.training.seed);
  std::ostringstream report;
  std::size_t printed = 0;
  const auto print = [&] {
    const std::string text = report.str();
    std::cout << text.substr(printed) << std::flush;
    printed = text.size();
  };
  report << "# The thesis under its own rules\n\n"
         << options.training.dataset.steps << " steps, " << options.training.trainer.epochs << " epochs; trained on "
         << fileNames(filesOf(maps.training)) << "; best epoch chosen on " << fileNames(filesOf(maps.validation))
         << ". " << options.selection.count << " tasks of each set in at most ten maps, "
         << options.evaluation.rules.max_steps
         << " steps, corners may be cut, no shield, no escape, arrival within one cell; seed " << options.training.seed
         << ".\n\n";
  const std::vector<ReportAgent> agents = trainAgents(options, maps, report);
  appendProperties(report);
  constexpr double kScenarioPlaces = 120.0;  // cells: the longest of the first 300 scenarios of a file
  for (const double max_length : {options.selection.max_length, kScenarioPlaces}) {
    const GridComparison comparison = compare(options, maps, agents, max_length);
    report << "# Tables 3.7-3.9, paths of 10 to " << max_length << " cells\n\n" << reportTables(comparison);
    appendSolvedAverages(comparison, report);
    if (max_length == kScenarioPlaces) continue;
    print();  // figures may fail for want of gnuplot or of room on the disk, after hours of training
    std::ostringstream figures;
    writeFigures(comparison, drawGridTasks({"training", maps.training}, options.selection), options.evaluation,
                 options.output, figures);
    report << "# Figures 3.9-3.17\n\n" << figures.str();
  }
  writeTextFile(options.output + "/thesis.md", report.str());
  print();
  std::cout << "wrote " << options.output << "/thesis.md\n";
  return 0;
}

}  // namespace lstm_planner
