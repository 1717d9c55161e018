#include "tools/report_files.hpp"

#include "lstm_planner/grid_world/evaluation/grid_thesis.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"
#include "tools/ranks.hpp"

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

}  // namespace

void evaluateAll(const GridEvaluationOptions& options, GridComparison* comparison) {
  Progress progress;
  const auto runs = static_cast<double>(comparison->sets.size() * comparison->agents.size());
  double done = 0.0;
  for (const GridTaskSet& set : comparison->sets) {
    comparison->episodes.emplace_back();
    for (const ReportAgent& agent : comparison->agents) {
      GridEvaluationOptions evaluation = options;
      evaluation.communicator = ranks();
      evaluation.progress = [&](double share) { progress.show((done + share) / runs); };
      comparison->episodes.back().push_back(evaluateGridTasks(set, 0, set.tasks.size(), agent.agent.make, evaluation));
      ++done;
    }
  }
}

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

}  // namespace lstm_planner
