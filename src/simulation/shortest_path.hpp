#pragma once

#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// Length of the shortest path, in any direction, from the middle of one cell to that of another through cells whose
/// distance-field value is at least `clearance` (m); +inf where there is none. Found by Lazy Theta* (A. Nash, S.
/// Koenig, C. Tovey, "Lazy Theta*", AAAI 2010): its paths bend only at corners, but it does not promise the very
/// shortest; in buildings it is within about 1 % of it, where paths along the eight directions of a grid are up to 8 %
/// too long. `to_goal` holds those lengths with the same clearance.
double shortestPath(const DistanceField& distances, const GeodesicField& to_goal, const OccupancyGrid& grid,
                    CellIndex start, CellIndex goal, double clearance);

}  // namespace lstm_planner
