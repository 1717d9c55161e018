#include "lstm_planner/grid_world/evaluation/grid_episode.hpp"

#include <algorithm>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <string>

#include "grid_world/agent/grid_walk.hpp"

namespace lstm_planner {
namespace {

/// Of this thread: unlike the time of day it does not count what else runs on the machine.
double processorSeconds() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
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

void countDecision(const GridAgent& agent, GridEpisode* episode) {
  ++episode->led[static_cast<std::size_t>(agent.leader())];
  episode->on_path += agent.onPath() ? 1 : 0;
  episode->overruled_by_shield += agent.overruled() == Overruled::kByShield ? 1 : 0;
  episode->overruled_by_bound += agent.overruled() == Overruled::kByBound ? 1 : 0;
}

/// Walks to the end.
GridEpisode::End run(const PassableGrid& grid, const GridEpisodeRules& rules, GridAgent* agent, GridWalk* walk,
                     std::vector<CellIndex>* path, GridEpisode* episode) {
  const std::int64_t max_steps = rules.max_steps > 0 ? rules.max_steps : gridStepBound(grid);
  std::optional<CircleWatch> watch;
  if (rules.max_steps == 0) watch.emplace(grid);
  if (path != nullptr) path->assign(1, walk->cell());
  while (!walk->hasArrived()) {
    if (walk->moves() == max_steps || (watch && watch->isCircling(walk->cell()))) return GridEpisode::End::kTimeout;
    const GridObservation observation = walk->observe();
    agent->observe(observation);
    const int direction = agent->decide();
    if (direction == kNoPath) return GridEpisode::End::kNoPath;
    if (direction < 0 || direction >= kGridMoveCount) {
      throw std::logic_error("the agent decided for direction " + std::to_string(direction) + ", expected 0 to 7 or " +
                             std::to_string(kNoPath) + " for no path");
    }
    const bool moved = movePossible(observation.ranges, direction, rules.corner_cutting);
    if (moved) countDecision(*agent, episode);
    agent->step(direction, moved);
    if (!moved) return GridEpisode::End::kCollision;
    walk->move(direction);
    if (path != nullptr) path->push_back(walk->cell());
  }
  return GridEpisode::End::kArrived;
}

}  // namespace

std::int64_t gridStepBound(const PassableGrid& grid) {
  constexpr std::int64_t kStepsPerCell = 16;
  constexpr std::int64_t kFewest = 1000000;
  return std::max(kFewest, kStepsPerCell * static_cast<std::int64_t>(grid.size()));
}

double GridEpisode::ratio() const { return steps() == 0 || optimal_length <= 0.0 ? 1.0 : length() / optimal_length; }

GridEpisode runGridEpisode(const PassableGrid& grid, const RangeTable& ranges, CellIndex start, CellIndex goal,
                           const GridEpisodeRules& rules, GridAgent* agent, std::vector<CellIndex>* path) {
  if (!grid.passable(start)) {
    throw std::invalid_argument("an episode cannot start at column " + std::to_string(start.column) + ", row " +
                                std::to_string(start.row) + ": expected a passable cell of the map");
  }
  GridEpisode episode;
  const double seconds_before = processorSeconds();
  GridWalk walk(ranges, start, goal);
  agent->start(start, goal);
  episode.end = run(grid, rules, agent, &walk, path, &episode);
  episode.straight_moves = walk.straightMoves();
  episode.diagonal_moves = walk.diagonalMoves();
  episode.seconds = processorSeconds() - seconds_before;
  const auto searched = static_cast<std::int64_t>(agent->expandedCells());
  episode.expanded = searched > 0 ? searched : episode.steps();
  episode.peak_bytes = static_cast<std::int64_t>(agent->peakBytes());
  return episode;
}

}  // namespace lstm_planner
