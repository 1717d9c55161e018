#include "lstm_planner/grid_world/evaluation/grid_gallery.hpp"

#include <algorithm>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {
namespace {

std::vector<std::size_t> arrivalsByRatio(const std::vector<GridEpisode>& episodes) {
  std::vector<std::size_t> arrived = tasksThatEnded(episodes, GridEpisode::End::kArrived);
  std::stable_sort(arrived.begin(), arrived.end(),
                   [&](std::size_t a, std::size_t b) { return episodes[a].ratio() < episodes[b].ratio(); });
  return arrived;
}

}  // namespace

const char* toString(GridEpisode::End end) {
  switch (end) {
    case GridEpisode::End::kArrived:
      return "arrived";
    case GridEpisode::End::kCollision:
      return "collision";
    case GridEpisode::End::kTimeout:
      return "timeout";
    case GridEpisode::End::kNoPath:
      return "no path";
  }
  return "";
}

GridPicture pictureOfTask(const GridTaskSet& set, std::size_t task, const std::vector<NamedGridAgent>& agents,
                          const GridEpisodeRules& rules) {
  const GridTask& given = set.tasks[task];
  const PassableGrid& grid = set.maps[given.map];
  const RangeTable ranges(grid);
  GridPicture picture;
  picture.title = set.name + ", " + set.map_names[given.map] + ": optimum " + fixedText(given.optimal_length, 1);
  picture.start = given.start;
  picture.goal = given.goal;
  for (const NamedGridAgent& agent : agents) {
    GridPicture::Path path;
    const GridEpisode episode =
        runGridEpisode(grid, ranges, given.start, given.goal, rules, agent.make(grid).get(), &path.cells);
    path.arrived = episode.end == GridEpisode::End::kArrived;
    path.label = agent.name + ": " + toString(episode.end) + " after " + fixedText(episode.length(), 1);
    picture.paths.push_back(path);
  }
  return picture;
}

std::optional<std::size_t> longestDetour(const std::vector<GridEpisode>& episodes) {
  const std::vector<std::size_t> arrived = arrivalsByRatio(episodes);
  if (arrived.empty()) return std::nullopt;
  return arrived.back();
}

std::optional<std::size_t> typicalArrival(const std::vector<GridEpisode>& episodes) {
  const std::vector<std::size_t> arrived = arrivalsByRatio(episodes);
  if (arrived.empty()) return std::nullopt;
  return arrived[arrived.size() / 2];
}

std::vector<std::size_t> tasksThatEnded(const std::vector<GridEpisode>& episodes, GridEpisode::End end) {
  std::vector<std::size_t> tasks;
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    if (episodes[i].end == end) tasks.push_back(i);
  }
  std::stable_sort(tasks.begin(), tasks.end(), [&](std::size_t a, std::size_t b) {
    return episodes[a].optimal_length < episodes[b].optimal_length;
  });
  return tasks;
}

}  // namespace lstm_planner
