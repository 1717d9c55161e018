#include "lstm_planner/grid_world/agent/boundary_follower.hpp"

#include <algorithm>

#include "grid_world/agent/nearer_cell.hpp"
#include "lstm_planner/common/parameter_check.hpp"

namespace lstm_planner {

BoundaryFollower::BoundaryFollower(const BoundaryParameters& parameters)
    : parameters_(parameters), trail_(parameters.corner_cutting) {
  checkNotNegative("first_leg", parameters.first_leg);
  checkNotNegative("leg_growth", parameters.leg_growth);
  checkNotNegative("goal_weight", parameters.goal_weight);
  for (End& end : ends_) end.cells.reserve(kMostCells + 3);
}

void BoundaryFollower::start(CellIndex /*start*/, CellIndex /*goal*/) {
  started_ = false;
  state_ = State::kGoing;
}

void BoundaryFollower::observe(const GridObservation& observation) {
  const GridObservation before = now_;
  now_ = observation;
  if (started_ && observation.cell == before.cell && observation.goal == before.goal) return;
  if (!started_ || observation.cell != expected_ || observation.goal != before.goal) {
    started_ = true;
    state_ = State::kGoing;
    best_ = octileDistance(observation.cell, observation.goal);
  } else if (state_ == State::kFollowing || state_ == State::kReturning) {
    leg_ += moveLength(rayBetween(before.cell, now_.cell));
    trail_.moved(before.cell, now_, state_ == State::kFollowing ? end_ : -1);
  }
  decision_ = nextDirection();
  expected_ = decision_ == kNoPath ? now_.cell : cellBeside(now_.cell, decision_);
}

int BoundaryFollower::nextDirection() {
  if (now_.cell == now_.goal) return kNoPath;
  const OctileDistance distance = octileDistance(now_.cell, now_.goal);
  if (distance < best_) {
    best_ = distance;
    state_ = State::kGoing;
  }
  if (state_ == State::kGoing) {
    const int direction = directionToNearerNeighbour(now_, best_, parameters_.corner_cutting);
    if (direction != kNoPath) return direction;
    meetBoundary();
  }
  if (state_ == State::kLeaving || seesNearerCell()) return leaving_direction_;
  if (state_ == State::kFollowing && shouldTurnBack()) {
    state_ = State::kReturning;
    end_ = 1 - end_;
  }
  if (state_ == State::kReturning) {
    if (!trail_.atEnd(end_)) return trail_.directionTo(end_, now_.cell);
    startLeg(end_);
  }
  End* end = &ends_[static_cast<std::size_t>(end_)];
  if (!follow(end, ends_[static_cast<std::size_t>(1 - end_)].edge)) return kNoPath;
  return directionAlong(end);
}

void BoundaryFollower::meetBoundary() {
  const int wall = directionOfObstacle(now_);
  for (End& end : ends_) {
    end.edge = {now_.cell, wall};
    end.cells.clear();
  }
  ends_[0].side = WallSide::kRight;
  ends_[1].side = WallSide::kLeft;
  trail_.clear();
  startLeg(firstWallSide(now_, wall) == ends_[0].side ? 0 : 1);
}

void BoundaryFollower::startLeg(int end) {
  state_ = State::kFollowing;
  end_ = end;
  leg_ = 0.0;
  path_back_ = trail_.lengthTo(1 - end, now_.cell);
  leg_advanced_ = false;
}

bool BoundaryFollower::seesNearerCell() {
  const int direction = directionToNearerCell(now_, best_);
  if (direction == kNoPath) return false;
  leaving_direction_ = direction;
  state_ = State::kLeaving;
  return true;
}

bool BoundaryFollower::follow(End* end, const BoundaryEdge& other) {
  while (end->cells.size() < kMostCells && !(octileDistance(end->edge.cell, now_.goal) < best_)) {
    const BoundaryStep step = nextAlongBoundary(now_, end->edge, end->side, parameters_.corner_cutting);
    if (step.kind == BoundaryStep::Kind::kUnseen) break;
    end->edge = step.next;
    leg_advanced_ = true;
    if (end->edge == other) return false;
    for (int i = 0; i < step.cell_count; ++i) append(end, step.cells[i]);
  }
  return true;
}

void BoundaryFollower::append(End* end, CellIndex cell) const {
  const CellIndex last = end->cells.empty() ? now_.cell : end->cells.back();
  if (cell != last) end->cells.push_back(cell);
}

int BoundaryFollower::directionAlong(End* end) const {
  std::vector<CellIndex>& cells = end->cells;
  const std::size_t known = cells.size();
  if (!(octileDistance(end->edge.cell, now_.goal) < best_)) {
    const BoundaryStep step = nextAlongBoundary(now_, end->edge, end->side, parameters_.corner_cutting);
    if (step.kind == BoundaryStep::Kind::kUnseen && step.cell_count == 1) cells.push_back(step.cells[0]);
  }
  // The farthest of the cells ahead that can be entered from here; bends in between are skipped.
  std::size_t skipped = cells.size();
  int direction = kNoPath;
  while (direction == kNoPath && skipped-- > 0) {
    const int towards = rayBetween(now_.cell, cells[skipped]);
    if (towards != kNoPath && movePossible(now_.ranges, towards, parameters_.corner_cutting)) direction = towards;
  }
  cells.resize(known);
  cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(std::min(skipped + 1, known)));
  return direction;
}

bool BoundaryFollower::shouldTurnBack() const {
  if (trail_.lost() || !leg_advanced_) return false;
  // Longer towards the goal than away from it.
  const double here = octileDistance(now_.cell, now_.goal).length();
  const double there = octileDistance(ends_[static_cast<std::size_t>(1 - end_)].edge.cell, now_.goal).length();
  const double longest = std::max(parameters_.first_leg, parameters_.leg_growth * path_back_);
  return leg_ > longest + parameters_.goal_weight * (there - here);
}

std::size_t BoundaryFollower::peakBytes() const { return sizeof(*this) + 2 * (kMostCells + 3) * sizeof(CellIndex); }

}  // namespace lstm_planner
