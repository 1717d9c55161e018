#include "lstm_planner/drive/local_map/route_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/drive/local_map/kept_route.hpp"

namespace lstm_planner {

RouteBounds::RouteBounds(const MemoryParameters& parameters, const ShieldParameters& shield)
    : reach_(KeptRoute::reachOfChanges(parameters, shield)), tightness_(parameters.tightness) {}

void RouteBounds::noteSearch(const LocalMap& memory, const Point2& start, const Point2& goal) {
  searched_goal_ = goal;
  through_freed_ = CostToGo::kNone;
  freed_from_ = memory.cellAt(start);
}

void RouteBounds::noteRoute(const LocalMap& memory, const CostToGo& costs, const Point2& here, double cost) {
  const std::uint32_t searched_cost = costs.cost(memory.cellAt(here));
  // Where the robot is nearer to something than any path may come, the start of each path has no cost.
  scale_ = std::isfinite(cost) && searched_cost > 0 ? cost / searched_cost : memory.cellSize() / kStraightFifths;
}

void RouteBounds::takeInChanges(LocalMap* memory, const CostToGo& costs, const Point2& here, const Point2& goal,
                                double enough) {
  const int cell = memory->cellAt(here);
  if (through_freed_ != CostToGo::kNone) {
    through_freed_ -= std::min(through_freed_, costs.octileBetween(freed_from_, cell));
  }
  freed_from_ = cell;
  const double fifths = std::isfinite(enough) ? enough / scale_ : leastFifths(*memory, costs, here, goal);
  const int reach = static_cast<int>(std::ceil(reach_ / memory->cellSize())) + 1;
  int last = -1;
  for (const LocalMap::Change& change : memory->changes()) {
    const int freed = memory->cellAt(change.place);
    if (!change.occupied && freed >= 0 && freed != last) {
      last = freed;
      const auto wanted = static_cast<std::uint32_t>(std::clamp(std::ceil(fifths), 0.0, 1e9));
      through_freed_ = std::min(through_freed_, costs.cheapestThrough(*memory, freed, reach, cell, wanted));
    }
  }
  memory->clearChanges();
}

double RouteBounds::leastCost(const LocalMap& memory, const CostToGo& costs, const Point2& here,
                              const Point2& goal) const {
  return leastFifths(memory, costs, here, goal) * scale_;
}

double RouteBounds::throughFreed(const LocalMap& memory) const {
  return CostToGo::metres(through_freed_, memory.cellSize());
}

std::uint32_t RouteBounds::leastFifths(const LocalMap& memory, const CostToGo& costs, const Point2& here,
                                       const Point2& goal) const {
  const std::uint32_t least = std::min(through_freed_, costs.cost(memory.cellAt(here)));
  const double moved = distanceBetween(goal, searched_goal_);
  if (least == CostToGo::kNone || moved == 0.0 || memory.cellAt(goal) == memory.cellAt(searched_goal_)) {
    return least;
  }
  const double costlier = tightness_ * (moved + 2.0 * memory.cellSize()) / memory.cellSize();
  return least - std::min(least, static_cast<std::uint32_t>(kDiagonalFifths * costlier));
}

}  // namespace lstm_planner
