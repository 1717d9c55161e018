#include "grid_world/agent/boundary_agent.hpp"

namespace lstm_planner {

void BoundaryAgent::start(CellIndex, CellIndex) { follower_.start(); }

void BoundaryAgent::step(int, bool) {}

}  // namespace lstm_planner
