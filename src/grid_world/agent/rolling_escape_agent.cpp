#include "grid_world/agent/rolling_escape_agent.hpp"

#include <algorithm>

namespace lstm_planner {

RollingEscapeAgent::RollingEscapeAgent(const GridRescueParameters& parameters)
    : corner_cutting_(parameters.corner_cutting), rescue_(parameters), greedy_(parameters.corner_cutting) {}

void RollingEscapeAgent::start(CellIndex start, CellIndex goal) {
  memory_.emplace(Memory{RollingPlanner(corner_cutting_), VisitTrace()});
  memory_->planner.start();
  rescue_.start(start);
  greedy_.start(start, goal);
  expanded_ = 0;
  peak_bytes_ = memory_->planner.bytes() + VisitTrace::bytes();
}

void RollingEscapeAgent::observe(const GridObservation& observation) {
  greedy_.observe(observation);
  if (memory_) lookAhead(observation);
  if (memory_) return;
  rescue_.observe(observation);
  peak_bytes_ = std::max(peak_bytes_, rescue_.bytes());
}

void RollingEscapeAgent::lookAhead(const GridObservation& observation) {
  RollingPlanner& planner = memory_->planner;
  planner.observe(observation);
  const bool new_place = memory_->trace.visit(observation.cell);
  if (!rescue_.isNeeded(observation, new_place, planner.detour(observation))) return;
  const RollingGrid walls = planner.walls();
  expanded_ = planner.expandedCells();
  memory_.reset();
  rescue_.takeOver(observation, &walls);
}

int RollingEscapeAgent::decide() {
  if (rescue_.active()) return rescue_.decide();
  return memory_->planner.direction() == kNoPath ? greedy_.decide() : memory_->planner.direction();
}

GridLeader RollingEscapeAgent::leader() const {
  if (rescue_.active()) return rescue_.leader();
  return memory_->planner.direction() == kNoPath ? GridLeader::kGreedy : GridLeader::kSearch;
}

std::size_t RollingEscapeAgent::expandedCells() const {
  return memory_ ? memory_->planner.expandedCells() : expanded_ + rescue_.expandedCells();
}

std::size_t RollingEscapeAgent::peakBytes() const { return sizeof(*this) + peak_bytes_; }

}  // namespace lstm_planner
