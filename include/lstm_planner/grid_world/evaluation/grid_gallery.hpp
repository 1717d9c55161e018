#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/evaluation/grid_picture.hpp"

namespace lstm_planner {

/// An agent as tables and pictures call it.
struct NamedGridAgent {
  std::string name;
  GridAgentMaker make;
};

/// Runs a task once more with each agent and puts their paths, lengths and ends into one picture.
GridPicture pictureOfTask(const GridTaskSet& set, std::size_t task, const std::vector<NamedGridAgent>& agents,
                          const GridEpisodeRules& rules);

/// Of the tasks that arrived, the one with the longest path relative to the optimum; empty if none arrived.
std::optional<std::size_t> longestDetour(const std::vector<GridEpisode>& episodes);

/// Of the tasks that arrived, the one with the median ratio; empty if none arrived.
std::optional<std::size_t> typicalArrival(const std::vector<GridEpisode>& episodes);

/// The tasks with the given end, the shortest optimum first.
std::vector<std::size_t> tasksThatEnded(const std::vector<GridEpisode>& episodes, GridEpisode::End end);

/// "arrived", "collision", "timeout", "no path".
const char* toString(GridEpisode::End end);

}  // namespace lstm_planner
