#include <optional>
#include <string>

#include "lstm_planner/grid_world/evaluation/grid_report.hpp"
#include "lstm_planner/grid_world/evaluation/grid_thesis.hpp"

namespace lstm_planner {
namespace {

/// The agent with the paths of those that search beside it, drawn over it.
std::vector<NamedGridAgent> withSearches(const GridComparison& comparison, std::size_t agent) {
  std::vector<NamedGridAgent> agents = {comparison.agents[agent].agent};
  for (const ReportAgent& other : comparison.agents) {
    if (other.searches && other.agent.name != agents.front().name) agents.push_back(other.agent);
  }
  return agents;
}

/// The first agent that does not search: what the report is about.
std::size_t subject(const GridComparison& comparison) {
  for (std::size_t agent = 0; agent < comparison.agents.size(); ++agent) {
    if (!comparison.agents[agent].searches) return agent;
  }
  return 0;
}

/// The set of a trend figure of the thesis.
std::optional<std::size_t> setOfFigure(const GridComparison& comparison, const std::string& figure) {
  for (std::size_t set = 0; set < comparison.sets.size(); ++set) {
    const ThesisTable* thesis = thesisTableOf(comparison.sets[set].name);
    if (thesis != nullptr && thesis->trend_figure == figure) return set;
  }
  return std::nullopt;
}

/// A task of a set in which some agent, the subject first, ended so: the easiest one, or one a quarter up the list, as
/// the easiest deadlocks are trifles.
bool findMiss(const GridComparison& comparison, std::size_t set, GridEpisode::End end, ReportPicture* picture) {
  const std::size_t agents = comparison.agents.size();
  for (std::size_t i = 0; i < agents; ++i) {
    const std::size_t agent = (subject(comparison) + i) % agents;
    const std::vector<std::size_t> missed = tasksThatEnded(comparison.episodes[set][agent], end);
    if (missed.empty()) continue;
    picture->set = set;
    picture->task = end == GridEpisode::End::kTimeout ? missed[missed.size() / 4] : missed.front();
    picture->agents = withSearches(comparison, agent);
    return true;
  }
  return false;
}

}  // namespace

std::vector<ReportPicture> choosePictures(const GridComparison& comparison) {
  std::vector<ReportPicture> pictures;
  const std::size_t agent = subject(comparison);
  const auto add = [&](const char* name, const char* caption, std::size_t set, std::optional<std::size_t> task) {
    if (task) pictures.push_back({name, caption, set, *task, withSearches(comparison, agent)});
  };
  if (const auto dragon_age = setOfFigure(comparison, "3.15")) {
    add("figure_3_10", "Figure 3.10: solved, with the longest detour", *dragon_age,
        longestDetour(comparison.episodes[*dragon_age][agent]));
  }
  ReportPicture miss{"figure_3_11", "Figure 3.11: failed, by hitting an obstacle", 0, 0, {}};
  for (std::size_t set = 0; set < comparison.sets.size(); ++set) {
    if (!findMiss(comparison, set, GridEpisode::End::kCollision, &miss)) continue;
    pictures.push_back(miss);
    break;
  }
  if (const auto maze = setOfFigure(comparison, "3.16")) {
    miss.name = "figure_3_12";
    miss.caption = "Figure 3.12: not solved in time in a maze";
    if (findMiss(comparison, *maze, GridEpisode::End::kTimeout, &miss)) pictures.push_back(miss);
    add("figure_3_13", "Figure 3.13: a way out of blind alleys in a maze", *maze,
        typicalArrival(comparison.episodes[*maze][agent]));
  }
  if (const auto random = setOfFigure(comparison, "3.17")) {
    add("figure_3_14", "Figure 3.14: local paths around obstacles in a random map", *random,
        typicalArrival(comparison.episodes[*random][agent]));
  }
  return pictures;
}

ReportPicture trainingPicture(const GridComparison& comparison, std::size_t set, std::size_t task) {
  return {"figure_3_09", "Figure 3.9: in a map of the training set", set, task,
          withSearches(comparison, subject(comparison))};
}

}  // namespace lstm_planner
