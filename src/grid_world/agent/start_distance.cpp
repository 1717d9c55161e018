#include "lstm_planner/grid_world/agent/start_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid_world/agent/along_ray.hpp"

namespace lstm_planner {
namespace {

constexpr int kBlockShift = 2;   ///< log2 of the block's side, cells
constexpr int kWindowShift = 6;  ///< log2 of the window's side, blocks
constexpr std::size_t kWindowBlocks = std::size_t{1} << (2 * kWindowShift);
constexpr float kUnit = 0.25f;  ///< cells, of the numbers that are kept
constexpr std::uint16_t kNotVisited = std::numeric_limits<std::uint16_t>::max();
constexpr float kMostDistance = (kNotVisited - 1) * kUnit;

/// From a cell to the middle of the block that another one lies in.
float lengthToMiddle(CellIndex cell, CellIndex other) {
  const auto along = [](int from, int to) {
    constexpr float kHalf = ((1 << kBlockShift) - 1) / 2.0f;
    return std::abs(static_cast<float>((to >> kBlockShift) * (1 << kBlockShift) - from) + kHalf);
  };
  return octileCells(along(cell.column, other.column), along(cell.row, other.row));
}

}  // namespace

StartDistance::StartDistance() : distances_(kWindowBlocks, kNotVisited), tags_(kWindowBlocks) {}

void StartDistance::clear() {
  std::fill(distances_.begin(), distances_.end(), kNotVisited);
  rays_.fill({});
  last_.reset();
  here_ = 0.0f;
}

std::size_t StartDistance::entryOf(CellIndex cell) {
  constexpr int kMask = (1 << kWindowShift) - 1;
  return static_cast<std::size_t>(((cell.row >> kBlockShift & kMask) << kWindowShift) |
                                  (cell.column >> kBlockShift & kMask));
}

std::uint8_t StartDistance::tagOf(CellIndex cell) {
  constexpr int kShift = kBlockShift + kWindowShift;
  return static_cast<std::uint8_t>((cell.row >> kShift & 15) << 4 | (cell.column >> kShift & 15));
}

std::optional<float> StartDistance::at(CellIndex cell) const {
  const std::size_t entry = entryOf(cell);
  if (distances_[entry] == kNotVisited || tags_[entry] != tagOf(cell)) return std::nullopt;
  return static_cast<float>(distances_[entry]) * kUnit;
}

std::optional<float> StartDistance::probe(CellIndex cell, std::size_t direction, int steps) {
  const CellIndex ahead = alongRay(cell, direction, steps);
  const std::optional<float> distance = at(ahead);
  if (distance) here_ = std::min(here_, *distance + lengthToMiddle(cell, ahead));
  return distance;
}

void StartDistance::observe(const GridObservation& observation) {
  const CellIndex cell = observation.cell;
  if (last_) here_ += octileCells(*last_, cell);
  last_ = cell;
  for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
    const int free = observation.ranges[direction] - 1;
    const int near = std::min(free, kNearProbe);
    const int far = std::min(free, kFarProbe);
    rays_[direction] = {};
    if (near >= 1) rays_[direction].near = probe(cell, direction, near);
    if (far > near) rays_[direction].far = probe(cell, direction, far);
  }
  const std::optional<float> known = at(cell);
  const float to_middle = lengthToMiddle(cell, cell);
  if (known) here_ = std::min(here_, *known + to_middle);
  const float distance = std::min(here_ + to_middle, kMostDistance);
  if (known && distance >= *known) return;
  const std::size_t entry = entryOf(cell);
  distances_[entry] = static_cast<std::uint16_t>(std::ceil(distance / kUnit));
  tags_[entry] = tagOf(cell);
}

std::size_t StartDistance::bytes() {
  return sizeof(StartDistance) + kWindowBlocks * (sizeof(std::uint16_t) + sizeof(std::uint8_t));
}

}  // namespace lstm_planner
