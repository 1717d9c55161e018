#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"

namespace lstm_planner {

namespace {

double ledBy(const GridSetSummary& summary, GridLeader leader) { return summary.led[static_cast<std::size_t>(leader)]; }

constexpr GridLeader kLeaders[] = {GridLeader::kNetwork, GridLeader::kSearch, GridLeader::kBoundary,
                                   GridLeader::kGreedy};

/// Of all steps; and of those of the network the ones that went where the search among its inputs would have gone.
void printLeaders(std::ostream& out, const GridSetSummary& summary) {
  const auto percent = [&](double share, int columns) {
    out << std::setprecision(1) << std::setw(columns - 1) << 100.0 * share << '%';
  };
  percent(ledBy(summary, GridLeader::kNetwork), 17);
  percent(ledBy(summary, GridLeader::kSearch), 9);
  percent(ledBy(summary, GridLeader::kBoundary), 10);
  if (summary.as_searched > 0.0) {
    percent(summary.as_searched, 13);
  } else {
    out << std::setw(13) << '-';
  }
}

/// A mean over the scenarios with success, of which there may be none.
void printMean(std::ostream& out, double mean, int decimals, int columns) {
  if (std::isfinite(mean)) {
    out << std::setprecision(decimals) << std::setw(columns) << mean;
  } else {
    out << std::setw(columns) << '-';
  }
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
          {"as_searched", summary.as_searched}};
}

void printGridSummaries(std::ostream& out, const std::vector<GridSetSummary>& summaries) {
  std::size_t width = 3;
  for (const GridSetSummary& summary : summaries) width = std::max(width, summary.name.size());
  const auto name_width = static_cast<int>(width);
  out << std::left << std::setw(name_width) << "set" << std::right
      << "  scenarios  arrived  collided  timeout  no path  length/optimum: mean  median    95 %  length  optimum"
         "   time [ms]  expanded  ns/step  peak [KiB]  led by: network   search  boundary  as searched\n";
  out << std::fixed;
  for (const GridSetSummary& summary : summaries) {
    const auto percent = [&](std::size_t count, int columns) {
      out << std::setprecision(2) << std::setw(columns - 1) << 100.0 * summary.share(count) << '%';
    };
    out << std::left << std::setw(name_width) << summary.name << std::right << std::setw(11) << summary.scenarios;
    percent(summary.arrived, 9);
    percent(summary.collisions, 10);
    percent(summary.timeouts, 9);
    percent(summary.no_path, 8);
    printMean(out, summary.mean_ratio, 3, 22);
    printMean(out, summary.median_ratio, 3, 8);
    printMean(out, summary.p95_ratio, 3, 8);
    printMean(out, summary.mean_length, 1, 8);
    printMean(out, summary.mean_optimal, 1, 9);
    printMean(out, 1e3 * summary.mean_time, 4, 12);
    printMean(out, summary.mean_expanded, 1, 10);
    out << std::setprecision(1) << std::setw(9) << summary.ns_per_step << std::setw(12)
        << static_cast<double>(summary.peak_bytes) / 1024.0;
    printLeaders(out, summary);
    out << '\n';
  }
}

}  // namespace lstm_planner
