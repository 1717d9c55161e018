#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"

namespace lstm_planner {

namespace {

double ledBy(const GridSetSummary& summary, GridLeader leader) { return summary.led[static_cast<std::size_t>(leader)]; }

constexpr GridLeader kLeaders[] = {GridLeader::kNetwork, GridLeader::kSearch, GridLeader::kBoundary,
                                   GridLeader::kGreedy};

std::string percent(double share, int decimals) { return fixedText(100.0 * share, decimals) + '%'; }

/// A mean over the scenarios with success, or over steps: there may be none.
std::string meanText(double mean, int decimals) { return std::isfinite(mean) ? fixedText(mean, decimals) : "-"; }

std::vector<std::string> cellsOf(const GridSetSummary& summary, std::size_t name_width) {
  return {leftText(summary.name, name_width),
          std::to_string(summary.scenarios),
          percent(summary.share(summary.arrived), 2),
          percent(summary.share(summary.collisions), 2),
          percent(summary.share(summary.timeouts), 2),
          percent(summary.share(summary.no_path), 2),
          meanText(summary.mean_ratio, 3),
          meanText(summary.median_ratio, 3),
          meanText(summary.p95_ratio, 3),
          meanText(summary.mean_length, 1),
          meanText(summary.mean_optimal, 1),
          meanText(1e3 * summary.mean_time, 4),
          meanText(summary.mean_expanded, 1),
          meanText(summary.ns_per_step, 1),
          fixedText(static_cast<double>(summary.peak_bytes) / 1024.0, 1),
          percent(ledBy(summary, GridLeader::kNetwork), 1),
          percent(ledBy(summary, GridLeader::kSearch), 1),
          percent(ledBy(summary, GridLeader::kBoundary), 1),
          percent(summary.on_path, 1),
          percent(summary.overruled_by_shield, 1),
          percent(summary.overruled_by_bound, 1)};
}

}  // namespace

nlohmann::json toJson(const GridSetSummary& summary) {
  nlohmann::json led;
  for (const GridLeader leader : kLeaders) led[nameOf(leader)] = ledBy(summary, leader);
  return {{"name", summary.name},
          {"scenarios", summary.scenarios},
          {"success", summary.share(summary.arrived)},
          {"collisions", summary.share(summary.collisions)},
          {"timeouts", summary.share(summary.timeouts)},
          {"mean_ratio", summary.mean_ratio},
          {"median_ratio", summary.median_ratio},
          {"p95_ratio", summary.p95_ratio},
          {"mean_length", summary.mean_length},
          {"mean_optimal", summary.mean_optimal},
          {"mean_time_s", summary.mean_time},
          {"mean_expanded", summary.mean_expanded},
          {"ns_per_step", summary.ns_per_step},
          {"peak_bytes", summary.peak_bytes},
          {"led", led},
          {"led_on_path", summary.on_path},
          {"overruled_by_shield", summary.overruled_by_shield},
          {"overruled_by_bound", summary.overruled_by_bound}};
}

void printGridSummaries(std::ostream& out, const std::vector<GridSetSummary>& summaries) {
  std::size_t width = 3;
  for (const GridSetSummary& summary : summaries) width = std::max(width, summary.name.size());
  const TextTable table(
      leftText("set", width) +
      "  scenarios  arrived  collided  timeout  no path  length/optimum: mean  median    95 %  length  optimum"
      "   time [ms]  expanded  ns/step  peak [KiB]  decided by: network   search  boundary  network on path  overruled "
      "by: shield   bound");
  out << table.headings() << '\n';
  for (const GridSetSummary& summary : summaries) out << table.line(cellsOf(summary, width)) << '\n';
}

}  // namespace lstm_planner
