#include "lstm_planner/grid_world/agent/boundary_trail.hpp"

#include <algorithm>
#include <cstdlib>

#include "grid_world/agent/nearer_cell.hpp"

namespace lstm_planner {
namespace {

int sign(int value) { return (value > 0) - (value < 0); }

CellIndex stepTowards(CellIndex from, CellIndex to) { return {sign(to.column - from.column), sign(to.row - from.row)}; }

int stepCount(CellIndex from, CellIndex to) {
  return std::max(std::abs(to.column - from.column), std::abs(to.row - from.row));
}

int directionOf(CellIndex step) { return std::max(0, rayBetween({0, 0}, step)); }

int cross(CellIndex a, CellIndex b) { return a.column * b.row - a.row * b.column; }

/// How many steps of `ray` lead from `cell` to a cell of the straight piece from `a` to `b`; 0 when none within
/// `reach`.
int stepsToMeet(CellIndex cell, CellIndex ray, int reach, CellIndex a, CellIndex b) {
  const CellIndex along = stepTowards(a, b);
  const CellIndex offset = {a.column - cell.column, a.row - cell.row};
  const int determinant = cross(ray, along);
  if (determinant == 0) {
    // On one line with the piece: its far corner is what to go for.
    const int steps = stepCount(cell, a);
    return cross(offset, ray) == 0 && stepTowards(cell, a) == ray && steps <= reach ? steps : 0;
  }
  const int ray_product = cross(offset, along);
  const int piece_product = cross(offset, ray);
  if (ray_product % determinant != 0 || piece_product % determinant != 0) return 0;
  const int steps = ray_product / determinant;
  const int piece_steps = piece_product / determinant;
  const bool on_piece = piece_steps >= 0 && piece_steps <= stepCount(a, b);
  return on_piece && steps >= 1 && steps <= reach ? steps : 0;
}

bool onPiece(CellIndex cell, CellIndex a, CellIndex b) {
  const CellIndex along = stepTowards(a, b);
  return cross({cell.column - a.column, cell.row - a.row}, along) == 0 && stepCount(a, cell) <= stepCount(a, b) &&
         stepCount(b, cell) <= stepCount(a, b);
}

bool canMeet(CellIndex cell, CellIndex a, CellIndex b) {
  const auto between = [](int x, int end, int other) {
    return x >= std::min(end, other) - 1 && x <= std::max(end, other) + 1;
  };
  return between(cell.column, a.column, b.column) || between(cell.row, a.row, b.row);
}

}  // namespace

void BoundaryTrail::clear() {
  counts_.fill(0);
  lost_ = false;
}

void BoundaryTrail::moved(CellIndex from, const GridObservation& observation, int follows) {
  if (lost_) return;
  if (counts_[0] + counts_[1] == 0) origin_ = from;
  for (int end = 0; end < 2; ++end) {
    if (end == follows) continue;
    extend(end, from, observation.cell);
    shorten(end, observation);
  }
  lost_ = lost_ || counts_[0] + counts_[1] > kCapacity;
}

CellIndex BoundaryTrail::corner(int end, std::size_t i) const {
  const Corner& corner = corners_[placeOf(end, i)];
  return {origin_.column + corner.column, origin_.row + corner.row};
}

void BoundaryTrail::push(int end, CellIndex cell) {
  const auto column = static_cast<std::int16_t>(cell.column - origin_.column);
  const auto row = static_cast<std::int16_t>(cell.row - origin_.row);
  lost_ = lost_ || origin_.column + column != cell.column || origin_.row + row != cell.row;
  corners_[placeOf(end, counts_[index(end)]++)] = {column, row};
}

void BoundaryTrail::extend(int end, CellIndex from, CellIndex to) {
  const CellIndex step = stepTowards(from, to);
  if (atEnd(end)) {
    push(end, from);
    return;
  }
  const CellIndex back = stepTowards(from, last(end));
  if (back == step) {
    if (last(end) == to) --counts_[index(end)];
    return;
  }
  if (back.column != -step.column || back.row != -step.row) push(end, from);
}

void BoundaryTrail::shorten(int end, const GridObservation& observation) {
  const CellIndex cell = observation.cell;
  std::array<int, kGridRayCount> reach{};
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    reach[static_cast<std::size_t>(direction)] = openSteps(observation, direction, corner_cutting_);
  }
  std::size_t& count = counts_[index(end)];
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const CellIndex a = corner(end, i);
    const CellIndex b = corner(end, i + 1);
    if (!canMeet(cell, a, b)) continue;
    if (onPiece(cell, a, b)) {
      count = cell == a ? i : i + 1;
      return;
    }
    for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
      const int steps = stepsToMeet(cell, kGridRaySteps[direction], reach[direction], a, b);
      if (steps == 0) continue;
      const CellIndex met = alongRay(cell, direction, steps);
      count = i + 1;
      if (met != a) push(end, met);
      return;
    }
  }
}

int BoundaryTrail::directionTo(int end, CellIndex cell) const { return directionOf(stepTowards(cell, last(end))); }

double BoundaryTrail::lengthTo(int end, CellIndex cell) const {
  double length = 0.0;
  for (std::size_t i = counts_[index(end)]; i-- > 0;) {
    const CellIndex next = corner(end, i);
    length += stepCount(cell, next) * moveLength(directionOf(stepTowards(cell, next)));
    cell = next;
  }
  return length;
}

}  // namespace lstm_planner
