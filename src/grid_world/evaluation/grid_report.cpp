#include "lstm_planner/grid_world/evaluation/grid_report.hpp"

#include <cmath>
#include <cstdio>
#include <sstream>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/markdown_table.hpp"
#include "lstm_planner/grid_world/evaluation/grid_thesis.hpp"

namespace lstm_planner {
namespace {

std::string formatted(const char* format, double value) {
  if (std::isnan(value)) return "-";
  char text[48];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

const std::vector<std::string>& heads() {
  static const std::vector<std::string> names = {"Agent",
                                                 "Success",
                                                 "Collisions",
                                                 "Timeouts",
                                                 "Average time (s)",
                                                 "Average length",
                                                 "Average optimum",
                                                 "Average nodes expanded",
                                                 "Length / optimum: mean",
                                                 "median",
                                                 "95 %",
                                                 "ns a step",
                                                 "Memory (KiB)"};
  return names;
}

std::vector<std::string> thesisRow(const ThesisTable::Row& row) {
  std::vector<std::string> cells = {"*" + row.agent + ", thesis*",
                                    formatted("%.0f %%", 100.0 * row.success),
                                    "-",
                                    "-",
                                    formatted("%.2e", row.seconds),
                                    formatted("%.2f", row.length),
                                    "-",
                                    formatted("%.2f", row.expanded)};
  cells.resize(heads().size(), "-");
  return cells;
}

std::vector<std::string> ourRow(const std::string& agent, const GridSetSummary& summary) {
  return {agent,
          formatted("%.1f %%", 100.0 * summary.share(summary.arrived)),
          formatted("%.1f %%", 100.0 * summary.share(summary.collisions)),
          formatted("%.1f %%", 100.0 * summary.share(summary.timeouts)),
          formatted("%.2e", summary.mean_time),
          formatted("%.2f", summary.mean_length),
          formatted("%.2f", summary.mean_optimal),
          formatted("%.2f", summary.mean_expanded),
          formatted("%.3f", summary.mean_ratio),
          formatted("%.3f", summary.median_ratio),
          formatted("%.3f", summary.p95_ratio),
          formatted("%.0f", summary.ns_per_step),
          formatted("%.1f", static_cast<double>(summary.peak_bytes) / 1024.0)};
}

void appendTable(const GridComparison& comparison, std::size_t set, std::ostream& out) {
  const std::string& name = comparison.sets[set].name;
  const ThesisTable* thesis = thesisTableOf(name);
  out << "## " << name;
  if (thesis != nullptr) out << " (thesis, Table " << thesis->number << ": " << thesis->title << ")";
  out << "\n\n" << comparison.sets[set].tasks.size() << " scenarios\n\n";
  MarkdownTable table(heads(), &out);
  if (thesis != nullptr) {
    for (const ThesisTable::Row& row : thesis->rows) table.row(thesisRow(row));
  }
  for (std::size_t agent = 0; agent < comparison.agents.size(); ++agent) {
    table.row(
        ourRow(comparison.agents[agent].agent.name, summarizeGridEpisodes(name, comparison.episodes[set][agent])));
  }
  out << '\n';
}

}  // namespace

std::string reportTables(const GridComparison& comparison) {
  std::ostringstream out;
  for (std::size_t set = 0; set < comparison.sets.size(); ++set) appendTable(comparison, set, out);
  return out.str();
}

std::string reportCsv(const GridComparison& comparison) {
  std::ostringstream out;
  CsvWriter csv(&out);
  csv.row("set", "agent", "scenarios", "success", "collisions", "timeouts", "mean_ratio", "median_ratio", "p95_ratio",
          "mean_length", "mean_optimal", "mean_time_s", "mean_expanded", "ns_per_step", "peak_bytes");
  for (std::size_t set = 0; set < comparison.sets.size(); ++set) {
    const std::string& name = comparison.sets[set].name;
    if (const ThesisTable* thesis = thesisTableOf(name)) {
      for (const ThesisTable::Row& row : thesis->rows) {
        constexpr int kScenarios = 50;
        csv.row(name, row.agent + ", thesis", kScenarios, row.success, "", "", "", "", "", row.length, "", row.seconds,
                row.expanded, "", "");
      }
    }
    for (std::size_t agent = 0; agent < comparison.agents.size(); ++agent) {
      const GridSetSummary summary = summarizeGridEpisodes(name, comparison.episodes[set][agent]);
      csv.row(name, comparison.agents[agent].agent.name, summary.scenarios, summary.share(summary.arrived),
              summary.share(summary.collisions), summary.share(summary.timeouts), summary.mean_ratio,
              summary.median_ratio, summary.p95_ratio, summary.mean_length, summary.mean_optimal, summary.mean_time,
              summary.mean_expanded, summary.ns_per_step, summary.peak_bytes);
    }
  }
  return out.str();
}

}  // namespace lstm_planner
