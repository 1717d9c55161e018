#include "lstm_planner/grid_world/agent/opening_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid_world/agent/along_ray.hpp"

namespace lstm_planner {
namespace {

using Opening = OpeningMemory::Opening;

constexpr std::size_t kMostOpenings = 340;
constexpr int kProbe = 9;            ///< cells ahead, or before the obstacle, where a ray shows an opening
constexpr int kShortestFree = 7;     ///< cells that such a ray is free at least
constexpr int kSamePlace = 5;        ///< cells; along both axes
constexpr float kLeastWalk = 16.0f;  ///< cells to an opening that lies behind

CellIndex placeOf(const Opening& opening) { return {opening.column, opening.row}; }

bool fits(int coordinate) {
  using Limits = std::numeric_limits<std::int16_t>;
  return coordinate >= Limits::min() && coordinate <= Limits::max();
}

bool isAt(const Opening& opening, CellIndex cell) {
  return std::abs(opening.column - cell.column) <= kSamePlace && std::abs(opening.row - cell.row) <= kSamePlace;
}

}  // namespace

OpeningMemory::OpeningMemory() { openings_.reserve(kMostOpenings); }

void OpeningMemory::clear() {
  openings_.clear();
  detours_.fill(std::nullopt);
  best_behind_.reset();
  here_ = 0.0f;
}

void OpeningMemory::observe(const GridObservation& observation, const VisitTrace& trace, float start_distance) {
  here_ = start_distance;
  forgetVisited(observation.cell);
  const float straight = octileCells(observation.cell, observation.goal);
  for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
    detours_[direction].reset();
    const int free = observation.ranges[direction] - 1;
    if (free < kShortestFree) continue;
    const int steps = std::min(free, kProbe);
    const CellIndex place = alongRay(observation.cell, direction, steps);
    if (trace.at(VisitTrace::kLargeBlock, place).count != 0) continue;
    const float length = rayLength(direction, steps);
    detours_[direction] = length + octileCells(place, observation.goal) - straight;
    note(place, length, observation.goal);
  }
  chooseBest(observation.goal);
}

void OpeningMemory::forgetVisited(CellIndex cell) {
  openings_.erase(
      std::remove_if(openings_.begin(), openings_.end(), [&](const Opening& opening) { return isAt(opening, cell); }),
      openings_.end());
  // The agent has gone back past the place where the path to an opening branches off: now it branches off here.
  for (Opening& opening : openings_) {
    if (here_ >= opening.branch) continue;
    opening.beyond += opening.branch - here_;
    opening.branch = here_;
  }
}

void OpeningMemory::note(CellIndex place, float length, CellIndex goal) {
  if (!fits(place.column) || !fits(place.row)) return;
  const Opening opening{static_cast<std::int16_t>(place.column), static_cast<std::int16_t>(place.row), here_, length};
  const auto known =
      std::find_if(openings_.begin(), openings_.end(), [&](const Opening& other) { return isAt(other, place); });
  if (known != openings_.end()) {
    if (walkTo(*known) > length) *known = opening;
    return;
  }
  if (openings_.size() < kMostOpenings) {
    openings_.push_back(opening);
    return;
  }
  const auto lengthBy = [&](const Opening& other) { return walkTo(other) + octileCells(placeOf(other), goal); };
  const auto worst = std::max_element(openings_.begin(), openings_.end(),
                                      [&](const Opening& a, const Opening& b) { return lengthBy(a) < lengthBy(b); });
  if (lengthBy(opening) < lengthBy(*worst)) *worst = opening;
}

void OpeningMemory::chooseBest(CellIndex goal) {
  best_behind_.reset();
  float shortest = std::numeric_limits<float>::infinity();
  for (const Opening& opening : openings_) {
    const float walk = walkTo(opening);
    if (walk < kLeastWalk) continue;
    const float length = walk + octileCells(placeOf(opening), goal);
    if (length >= shortest) continue;
    shortest = length;
    best_behind_ = opening;
  }
}

std::size_t OpeningMemory::bytes() { return sizeof(OpeningMemory) + kMostOpenings * sizeof(Opening); }

}  // namespace lstm_planner
