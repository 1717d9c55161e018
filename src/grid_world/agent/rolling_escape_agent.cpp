#include "grid_world/agent/rolling_escape_agent.hpp"

namespace lstm_planner {
namespace {

GridEscapeParameters withCorners(GridEscapeParameters escape, CornerCutting corner_cutting) {
  escape.boundary.corner_cutting = corner_cutting;
  return escape;
}

}  // namespace

RollingEscapeAgent::RollingEscapeAgent(CornerCutting corner_cutting, GridEscapeParameters escape)
    : planner_(corner_cutting), escape_(withCorners(escape, corner_cutting)), greedy_(corner_cutting) {}

void RollingEscapeAgent::start(CellIndex start, CellIndex goal) {
  planner_.start();
  trace_.clear();
  escape_.start();
  greedy_.start(start, goal);
}

void RollingEscapeAgent::observe(const GridObservation& observation) {
  planner_.observe(observation);
  escape_.observe(observation, trace_.visit(observation.cell));
  greedy_.observe(observation);
}

int RollingEscapeAgent::decide() {
  if (escape_.active()) return escape_.decide();
  return planner_.direction() == kNoPath ? greedy_.decide() : planner_.direction();
}

GridLeader RollingEscapeAgent::leader() const {
  if (escape_.active()) return GridLeader::kBoundary;
  return planner_.direction() == kNoPath ? GridLeader::kGreedy : GridLeader::kSearch;
}

std::size_t RollingEscapeAgent::peakBytes() const {
  return sizeof(*this) - sizeof(planner_) + planner_.bytes() + VisitTrace::bytes() + escape_.peakBytes() -
         sizeof(escape_);
}

}  // namespace lstm_planner
