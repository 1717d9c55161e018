#include "lstm_planner/grid_world/evaluation/grid_episode.hpp"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <string>

namespace lstm_planner {
namespace {

/// Of this thread: unlike the time of day it does not count what else runs on the machine.
double processorSeconds() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool isNear(CellIndex cell, CellIndex goal, int distance) {
  return std::abs(cell.column - goal.column) <= distance && std::abs(cell.row - goal.row) <= distance;
}

/// Notices that an agent walks for long among cells that it has entered before.
class CircleWatch {
 public:
  explicit CircleWatch(const PassableGrid& grid) : grid_(grid), entered_(grid.size(), false) {}

  /// Once a step, with the cell where the agent is.
  bool isCircling(CellIndex cell) {
    std::vector<bool>::reference entered = entered_[grid_.offset(cell)];
    cells_entered_ += entered ? 0 : 1;
    steps_since_new_ = entered ? steps_since_new_ + 1 : 0;
    entered = true;
    return steps_since_new_ > circlingSteps(cells_entered_);
  }

 private:
  const PassableGrid& grid_;
  std::vector<bool> entered_;
  std::int64_t cells_entered_ = 0;
  std::int64_t steps_since_new_ = 0;
};

void countLeader(const GridAgent& agent, int direction, GridEpisode* episode) {
  const GridLeader leader = agent.leader();
  ++episode->led[static_cast<std::size_t>(leader)];
  if (leader == GridLeader::kNetwork && direction == agent.searchedDirection()) ++episode->as_searched;
}

/// Runs to the end and counts the moves.
void run(const PassableGrid& grid, const RangeTable& ranges, CellIndex cell, CellIndex goal,
         const GridEpisodeRules& rules, GridAgent* agent, std::vector<CellIndex>* path, GridEpisode* episode) {
  const std::int64_t max_steps = rules.max_steps > 0 ? rules.max_steps : gridStepBound(grid);
  std::optional<CircleWatch> watch;
  if (rules.max_steps == 0) watch.emplace(grid);
  agent->start(cell, goal);
  if (path != nullptr) path->assign(1, cell);
  for (std::int64_t steps = 0;; ++steps) {
    if (isNear(cell, goal, rules.arrival_distance)) {
      episode->end = GridEpisode::End::kArrived;
      return;
    }
    if (steps == max_steps || (watch && watch->isCircling(cell))) {
      episode->end = GridEpisode::End::kTimeout;
      return;
    }
    const GridObservation observation{cell, goal, ranges.at(cell)};
    agent->observe(observation);
    const int direction = agent->decide();
    if (direction == kNoPath) {
      episode->end = GridEpisode::End::kNoPath;
      return;
    }
    if (direction < 0 || direction >= kGridMoveCount) {
      throw std::logic_error("the agent decided for direction " + std::to_string(direction) + ", expected 0 to 7 or " +
                             std::to_string(kNoPath) + " for no path");
    }
    const bool moved = movePossible(observation.ranges, direction, rules.corner_cutting);
    if (moved) countLeader(*agent, direction, episode);
    agent->step(direction, moved);
    if (!moved) {
      episode->end = GridEpisode::End::kCollision;
      return;
    }
    cell = cellBeside(cell, direction);
    ++(direction % 2 == 0 ? episode->straight_moves : episode->diagonal_moves);
    if (path != nullptr) path->push_back(cell);
  }
}

}  // namespace

std::int64_t gridStepBound(const PassableGrid& grid) {
  constexpr std::int64_t kStepsPerCell = 16;
  constexpr std::int64_t kFewest = 1000000;
  return std::max(kFewest, kStepsPerCell * static_cast<std::int64_t>(grid.size()));
}

double GridEpisode::length() const {
  return static_cast<double>(straight_moves) * moveLength(0) + static_cast<double>(diagonal_moves) * moveLength(1);
}

double GridEpisode::ratio() const { return steps() == 0 || optimal_length <= 0.0 ? 1.0 : length() / optimal_length; }

GridEpisode runGridEpisode(const PassableGrid& grid, const RangeTable& ranges, CellIndex start, CellIndex goal,
                           const GridEpisodeRules& rules, GridAgent* agent, std::vector<CellIndex>* path) {
  if (!grid.passable(start)) {
    throw std::invalid_argument("an episode cannot start at column " + std::to_string(start.column) + ", row " +
                                std::to_string(start.row) + ": expected a passable cell of the map");
  }
  GridEpisode episode;
  const double begin = processorSeconds();
  run(grid, ranges, start, goal, rules, agent, path, &episode);
  episode.seconds = processorSeconds() - begin;
  const auto searched = static_cast<std::int64_t>(agent->expandedCells());
  episode.expanded = searched > 0 ? searched : episode.steps();
  episode.peak_bytes = static_cast<std::int64_t>(agent->peakBytes());
  return episode;
}

}  // namespace lstm_planner
