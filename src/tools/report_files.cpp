#include "tools/report_files.hpp"

#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/grid_world/evaluation/grid_thesis.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"
#include "tools/shared_file.hpp"

namespace lstm_planner {
namespace {

std::string fileName(const GridTaskSet& set) {
  const ThesisTable* thesis = thesisTableOf(set.name);
  if (thesis == nullptr) return "success_" + set.name;
  std::string name = "figure_" + thesis->trend_figure;
  name.replace(name.find('.'), 1, "_");
  return name;
}

void appendPicture(const std::string& caption, const std::string& file, std::ostream& out) {
  out << "![" << caption << "](" << file << ")\n\n" << caption << "\n\n";
}

std::string displayName(const std::string& agent) {
  static const std::map<std::string, std::string> names = {
      {"astar", "A*"}, {"dstar", "D*"}, {"lstm", "LSTM"}, {"rnn", "RNN"}, {"mlp", "MLP"}, {"qlearning", "Q-learning"}};
  const auto known = names.find(agent);
  return known == names.end() ? agent : known->second;
}

/// The options of one text, and what its name ends with.
GridAgentOptions optionsFrom(const std::string& text, GridAgentOptions options, std::string* suffix) {
  std::istringstream parts(text);
  std::string part;
  std::getline(parts, part, ',');
  const std::size_t equals = part.find('=');
  options.agent = part.substr(0, equals);
  options.model = equals == std::string::npos ? "" : part.substr(equals + 1);
  if (equals != std::string::npos && options.model.empty()) {
    throw std::invalid_argument("agent '" + text + "' has no file behind '=', expected NAME or NAME=MODEL");
  }
  if (isNetworkAgent(options.agent)) {
    options.model = findSharedFile(options.model.empty() ? shippedModelOf(options.agent) : options.model);
  } else if (!options.model.empty()) {
    throw std::invalid_argument("agent '" + text + "' has a model, but " + options.agent + " is no network");
  }
  while (std::getline(parts, part, ',')) {
    if (part == "no-shield") {
      options.network.shield = false;
    } else if (part == "no-escape") {
      options.network.guided = false;
    } else {
      throw std::invalid_argument("agent '" + text + "' has the flag '" + part + "', expected no-shield or no-escape");
    }
    *suffix += ", " + part.replace(2, 1, " ");
  }
  return options;
}

bool isTaken(const std::vector<ReportAgent>& agents, const std::string& name) {
  for (const ReportAgent& agent : agents) {
    if (agent.agent.name == name) return true;
  }
  return false;
}

/// Figures 3.15-3.17.
void writeTrends(const GridComparison& comparison, const std::string& folder, std::ostream& report) {
  for (std::size_t i = 0; i < comparison.sets.size(); ++i) {
    const GridTaskSet& set = comparison.sets[i];
    const std::string name = fileName(set);
    const std::string csv = folder + "/" + name + ".csv";
    writeTextFile(csv, successTrendCsv(comparison, i));
    drawSuccessTrend(comparison, i, csv, folder + "/" + name + ".png");
    const ThesisTable* thesis = thesisTableOf(set.name);
    appendPicture((thesis == nullptr ? "" : "Figure " + thesis->trend_figure + ": ") + "success in " + set.name +
                      " over the longest path allowed",
                  name + ".png", report);
  }
}

void drawPicture(const GridComparison& comparison, const ReportPicture& picture, const std::string& folder,
                 std::ostream& report) {
  const GridTaskSet& set = comparison.sets[picture.set];
  const std::string file = picture.name + ".png";
  writeGridPicture(folder + "/" + file, set.maps[set.tasks[picture.task].map],
                   pictureOfTask(set, picture.task, picture.agents, comparison.rules));
  appendPicture(picture.caption, file, report);
}

/// Figure 3.9. `tests`: whose agents and rules are meant.
void drawTrainingPicture(const GridTaskSet& set, const GridComparison& tests, const GridEvaluationOptions& options,
                         const std::string& folder, std::ostream& report) {
  GridComparison training;
  training.agents = tests.agents;
  training.rules = tests.rules;
  training.sets = {set};
  const ReportPicture first = trainingPicture(training, 0, 0);
  const std::vector<GridEpisode> episodes =
      evaluateGridTasks(set, 0, set.tasks.size(), first.agents.front().make, options);
  if (const auto task = typicalArrival(episodes)) {
    drawPicture(training, trainingPicture(training, 0, *task), folder, report);
  }
}

}  // namespace

void evaluateAll(const GridEvaluationOptions& options, GridComparison* comparison) {
  Progress progress;
  const auto runs = static_cast<double>(comparison->sets.size() * comparison->agents.size());
  double done = 0.0;
  for (const GridTaskSet& set : comparison->sets) {
    comparison->episodes.emplace_back();
    for (const ReportAgent& agent : comparison->agents) {
      GridEvaluationOptions evaluation = options;
      evaluation.progress = [&](double share) { progress.show((done + share) / runs); };
      comparison->episodes.back().push_back(evaluateGridTasks(set, 0, set.tasks.size(), agent.agent.make, evaluation));
      ++done;
    }
  }
}

void writeFigures(const GridComparison& comparison, const std::optional<GridTaskSet>& training,
                  const GridEvaluationOptions& options, const std::string& folder, std::ostream& report) {
  writeTrends(comparison, folder, report);
  if (training) drawTrainingPicture(*training, comparison, options, folder, report);
  for (const ReportPicture& picture : choosePictures(comparison)) drawPicture(comparison, picture, folder, report);
}

std::vector<ReportAgent> agentsFromTexts(const std::vector<std::string>& texts, const GridAgentOptions& common) {
  std::vector<ReportAgent> agents;
  for (const std::string& text : texts) {
    std::string suffix;
    const GridAgentOptions options = optionsFrom(text, common, &suffix);
    const GridAgentMaker make = gridAgentMaker(options);
    std::string name = displayName(options.agent) + suffix;
    if (isTaken(agents, name) && !options.model.empty()) {
      name = displayName(options.agent) + " " + std::filesystem::path(options.model).stem().string() + suffix;
    }
    if (isTaken(agents, name)) throw std::invalid_argument("agent '" + text + "' is given twice");
    agents.push_back({{name, make}, options.agent == "astar" || options.agent == "dstar"});
  }
  return agents;
}

}  // namespace lstm_planner
