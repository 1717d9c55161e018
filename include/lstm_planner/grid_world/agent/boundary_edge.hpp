#pragma once

#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// On which side the wall is kept while a boundary is followed.
enum class WallSide { kRight, kLeft };

/// A piece of an obstacle's boundary: the side of a free cell where the neighbour is blocked. `wall` is the direction
/// of this neighbour, even (east, north, west, south).
///
/// The edges of a connected region of free cells form cycles, one for each connected piece of boundary. If two blocked
/// cells touch at a corner, it depends on the rule for cutting corners which edge is the next one.
struct BoundaryEdge {
  CellIndex cell;
  int wall = 0;
};

inline bool operator==(BoundaryEdge a, BoundaryEdge b) { return a.cell == b.cell && a.wall == b.wall; }

/// How the boundary goes on behind an edge.
struct BoundaryStep {
  /// Whether the next edge is known.
  enum class Kind {
    kUnseen,  ///< not known, as it has not been seen; `cells` must be entered in any case
    kStep     ///< `next` is the next edge, reached over `cells`
  };
  Kind kind = Kind::kUnseen;
  BoundaryEdge next;
  int cell_count = 0;
  CellIndex cells[2];
};

/// The step along the cycle of `edge`, with the wall on the given side, as far as one observation shows it.
BoundaryStep nextAlongBoundary(const GridObservation& observation, BoundaryEdge edge, WallSide side,
                               CornerCutting corner_cutting);

}  // namespace lstm_planner
