#include "lstm_planner/grid_world/agent/boundary_edge.hpp"

#include <algorithm>
#include <cstdlib>

namespace lstm_planner {
namespace {

enum class SeenCell { kFree, kBlocked, kUnknown };

int directionTo(int columns, int rows) {
  const int column = (columns > 0) - (columns < 0);
  const int row = (rows > 0) - (rows < 0);
  return rayBetween({0, 0}, {column, row});
}

/// What the eight rays say about a cell.
SeenCell seenCell(const GridObservation& observation, CellIndex cell) {
  const int columns = cell.column - observation.cell.column;
  const int rows = cell.row - observation.cell.row;
  if (columns == 0 && rows == 0) return SeenCell::kFree;
  if (columns != 0 && rows != 0 && std::abs(columns) != std::abs(rows)) return SeenCell::kUnknown;
  const int steps = std::max(std::abs(columns), std::abs(rows));
  const int range = observation.ranges[static_cast<std::size_t>(directionTo(columns, rows))];
  if (steps < range) return SeenCell::kFree;
  return steps == range && range < kGridRayCap ? SeenCell::kBlocked : SeenCell::kUnknown;
}

BoundaryStep turnInPlace(BoundaryEdge edge, int travel) {
  return {BoundaryStep::Kind::kStep, {edge.cell, travel}, 0, {}};
}

BoundaryStep goAhead(BoundaryEdge edge, CellIndex ahead) {
  return {BoundaryStep::Kind::kStep, {ahead, edge.wall}, 1, {ahead, {}}};
}

}  // namespace

BoundaryStep nextAlongBoundary(const GridObservation& observation, BoundaryEdge edge, WallSide side,
                               CornerCutting corner_cutting) {
  const int travel = turned(edge.wall, side == WallSide::kRight ? 2 : -2);
  const CellIndex ahead = cellBeside(edge.cell, travel);
  const CellIndex corner = cellBeside(ahead, edge.wall);
  const SeenCell seen_ahead = seenCell(observation, ahead);
  const SeenCell seen_corner = seenCell(observation, corner);
  const BoundaryEdge around = {corner, opposite(travel)};

  if (corner_cutting == CornerCutting::kAllowed) {
    if (seen_corner == SeenCell::kUnknown) return {};
    if (seen_corner == SeenCell::kFree) return {BoundaryStep::Kind::kStep, around, 1, {corner, {}}};
    if (seen_ahead == SeenCell::kUnknown) return {};
    return seen_ahead == SeenCell::kBlocked ? turnInPlace(edge, travel) : goAhead(edge, ahead);
  }
  if (seen_ahead == SeenCell::kUnknown) return {};
  if (seen_ahead == SeenCell::kBlocked) return turnInPlace(edge, travel);
  if (seen_corner == SeenCell::kUnknown) return {BoundaryStep::Kind::kUnseen, {}, 1, {ahead, {}}};
  if (seen_corner == SeenCell::kBlocked) return goAhead(edge, ahead);
  return {BoundaryStep::Kind::kStep, around, 2, {ahead, corner}};
}

}  // namespace lstm_planner
