#include <algorithm>
#include <cmath>
#include <sstream>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/gnuplot.hpp"
#include "lstm_planner/grid_world/evaluation/grid_report.hpp"
#include "lstm_planner/grid_world/evaluation/grid_thesis.hpp"

namespace lstm_planner {
namespace {

constexpr int kLimits = 10;
constexpr double kThesisLimit = 300.0;  // cells, of the thesis's tables

double longestOptimum(const GridTaskSet& set) {
  double longest = 0.0;
  for (const GridTask& task : set.tasks) longest = std::max(longest, task.optimal_length);
  return longest;
}

/// Of tasks with an optimum of at most `limit`; not a number where there is none.
double success(const std::vector<GridEpisode>& episodes, double limit) {
  double tasks = 0.0;
  double arrived = 0.0;
  for (const GridEpisode& episode : episodes) {
    if (episode.optimal_length > limit) continue;
    ++tasks;
    arrived += episode.end == GridEpisode::End::kArrived ? 1.0 : 0.0;
  }
  return arrived / tasks;
}

/// The thesis's LSTM in its table.
const ThesisTable::Row* thesisLstm(const std::string& set_name) {
  const ThesisTable* thesis = thesisTableOf(set_name);
  return thesis == nullptr ? nullptr : &thesis->rows.back();
}

}  // namespace

std::string successTrendCsv(const GridComparison& comparison, std::size_t set) {
  std::ostringstream out;
  CsvWriter csv(&out, CsvWriter::Digits::kSix, ';');
  csv.add("longest optimum");
  for (const ReportAgent& agent : comparison.agents) csv.add(agent.agent.name);
  csv.endRow();
  const double step = std::ceil(longestOptimum(comparison.sets[set]) / kLimits);
  for (int i = 1; i <= kLimits; ++i) {
    const double limit = step * i;
    csv.add(limit);
    for (const std::vector<GridEpisode>& episodes : comparison.episodes[set]) csv.add(success(episodes, limit));
    csv.endRow();
  }
  return out.str();
}

namespace {

std::string scriptOf(const GridComparison& comparison, std::size_t set, const std::string& csv_path) {
  const GridTaskSet& tasks = comparison.sets[set];
  const std::string csv = quotedForGnuplot(csv_path);
  std::ostringstream script;
  script << "set datafile separator ';'; set datafile missing ''; set grid; set key outside right top; "
         << "set title " << quotedForGnuplot("Success in " + tasks.name) << "; "
         << "set xlabel 'longest optimal length of the scenarios [cells]'; set ylabel 'success [%]'; "
         << "set yrange [0:105]; set xrange [0:*]; plot ";
  for (std::size_t agent = 0; agent < comparison.agents.size(); ++agent) {
    script << (agent == 0 ? "" : ", ") << csv << " using 1:($" << agent + 2 << "*100) title "
           << quotedForGnuplot(comparison.agents[agent].agent.name) << " with linespoints lw 2 pt " << agent + 4;
  }
  const ThesisTable::Row* thesis = thesisLstm(tasks.name);
  if (thesis != nullptr) {
    script << ", '+' using (" << kThesisLimit << "):(" << 100.0 * thesis->success
           << ") every ::0::0 title 'LSTM, thesis (printed)' with points pt 3 ps 2 lw 2 lc 'black'";
  }
  script << ';';
  return script.str();
}

}  // namespace

void drawSuccessTrend(const GridComparison& comparison, std::size_t set, const std::string& csv_path,
                      const std::string& png_path) {
  runGnuplot("success trend", png_path, csv_path, "900,560 noenhanced", scriptOf(comparison, set, csv_path));
}

}  // namespace lstm_planner
