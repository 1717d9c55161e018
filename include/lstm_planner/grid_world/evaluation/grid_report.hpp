#pragma once

#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/evaluation/grid_gallery.hpp"
#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"

namespace lstm_planner {

/// An agent of a report.
struct ReportAgent {
  NamedGridAgent agent;
  bool searches = false;  ///< A* and D*: pictures show their paths, too
};

/// What several agents did in the same tasks.
struct GridComparison {
  std::vector<ReportAgent> agents;
  std::vector<GridTaskSet> sets;
  std::vector<std::vector<std::vector<GridEpisode>>> episodes;  ///< by set, by agent, by task
  GridEpisodeRules rules;
};

/// Tables 3.7-3.9 of the thesis for every set, as Markdown; the thesis's values are in the rows above ours.
std::string reportTables(const GridComparison& comparison);

/// A line for each set and agent, the thesis's included.
std::string reportCsv(const GridComparison& comparison);

/// Share of arrivals among the tasks whose optimum is within a limit, for growing limits (Figures 3.15-3.17): one line
/// a limit, one column an agent.
std::string successTrendCsv(const GridComparison& comparison, std::size_t set);

/// Draws such a CSV file with gnuplot; the thesis's printed figure is added where there is one. Throws
/// std::runtime_error when gnuplot is missing.
void drawSuccessTrend(const GridComparison& comparison, std::size_t set, const std::string& csv_path,
                      const std::string& png_path);

/// A picture of paths in a map, and what it shows.
struct ReportPicture {
  std::string name;  ///< of its file, without extension
  std::string caption;
  std::size_t set = 0;
  std::size_t task = 0;
  std::vector<NamedGridAgent> agents;
};

/// The thesis's Figures 3.10-3.14, as far as the comparison has such cases: a long detour, a collision, a deadlock, a
/// path out of a dead end in a maze, and a random map.
std::vector<ReportPicture> choosePictures(const GridComparison& comparison);

/// Figure 3.9: a task of a training map.
ReportPicture trainingPicture(const GridComparison& comparison, std::size_t set, std::size_t task);

}  // namespace lstm_planner
