#pragma once

#include "lstm_planner/grid_world/agent/boundary_follower.hpp"
#include "lstm_planner/grid_world/agent/boundary_memory.hpp"

namespace lstm_planner {

/// The move that following the boundary would choose next, from whatever an agent remembers: a teacher that a network
/// can imitate wherever its own moves have led it (Ross et al., "A reduction of imitation learning and structured
/// prediction to no-regret online learning", AISTATS 2011). BoundaryFollower would start anew there.
///
/// kNoPath: it knows none. `observation` is the memory's latest.
int taughtMove(const BoundaryMemory& memory, const GridObservation& observation,
               const BoundaryParameters& parameters = {});

}  // namespace lstm_planner
