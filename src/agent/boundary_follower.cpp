#include "lstm_planner/agent/boundary_follower.hpp"

#include <algorithm>
#include <cstdlib>

namespace lstm_planner {
namespace {

int directionBetween(CellIndex from, CellIndex to) {
  const CellIndex step = {to.column - from.column, to.row - from.row};
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (kGridRaySteps[static_cast<std::size_t>(direction)] == step) return direction;
  }
  return kNoWay;
}

int sign(int value) { return (value > 0) - (value < 0); }

}  // namespace

BoundaryFollower::BoundaryFollower(const BoundaryParameters& parameters)
    : parameters_(parameters), trail_(parameters.corner_cutting) {
  for (End& end : ends_) end.cells.reserve(kMostCells + 2);
}

void BoundaryFollower::start() {
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
    leg_ += moveLength(directionBetween(before.cell, now_.cell));
    trail_.moved(before.cell, now_, state_ == State::kFollowing ? end_ : -1);
  }
  decision_ = nextDirection();
  expected_ = decision_ == kNoWay ? now_.cell : cellBeside(now_.cell, decision_);
}

int BoundaryFollower::nextDirection() {
  if (now_.cell == now_.goal) return kNoWay;
  const OctileDistance distance = octileDistance(now_.cell, now_.goal);
  if (distance < best_) {
    best_ = distance;
    state_ = State::kGoing;
  }
  if (state_ == State::kGoing) {
    const int direction = nearerNeighbour();
    if (direction != kNoWay) return direction;
    meetBoundary();
  }
  if (state_ == State::kLeaving || seesNearerCell()) return leaving_direction_;
  if (state_ == State::kFollowing && shouldTurnBack()) {
    state_ = State::kReturning;
    end_ = 1 - end_;
  }
  if (state_ == State::kReturning) {
    if (!trail_.atEnd(end_)) return trail_.directionTo(end_, now_.cell);
    state_ = State::kFollowing;
    leg_ = 0.0;
    leg_advanced_ = false;
  }
  End* end = &ends_[static_cast<std::size_t>(end_)];
  std::vector<CellIndex> beyond;
  if (!follow(end, ends_[static_cast<std::size_t>(1 - end_)].edge)) return kNoWay;
  return directionAlong(end, &beyond);
}

int BoundaryFollower::nearerNeighbour() const {
  OctileDistance nearest = octileDistance(now_.cell, now_.goal);
  int best = kNoWay;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (!movePossible(now_.ranges, direction, parameters_.corner_cutting)) continue;
    const OctileDistance distance = octileDistance(cellBeside(now_.cell, direction), now_.goal);
    if (distance < nearest) {
      nearest = distance;
      best = direction;
    }
  }
  return best;
}

void BoundaryFollower::meetBoundary() {
  const int columns = now_.goal.column - now_.cell.column;
  const int rows = now_.goal.row - now_.cell.row;
  const bool along_columns = std::abs(columns) >= std::abs(rows);
  const int wall = along_columns ? (columns > 0 ? 0 : 4) : (rows > 0 ? 2 : 6);
  for (End& end : ends_) {
    end.edge = {now_.cell, wall};
    end.cells.clear();
  }
  ends_[0].side = WallSide::kRight;
  ends_[1].side = WallSide::kLeft;

  // The side that the goal is on; straight ahead, the one that is open for longer.
  const CellIndex right_hand = kGridRaySteps[static_cast<std::size_t>((wall + 2) % kGridMoveCount)];
  const int component = along_columns ? right_hand.row * sign(rows) : right_hand.column * sign(columns);
  const auto range = [&](int turn) { return now_.ranges[static_cast<std::size_t>((wall + turn) % kGridRayCount)]; };
  end_ = component != 0 ? (component > 0 ? 0 : 1) : (range(2) >= range(6) ? 0 : 1);
  leg_ = 0.0;
  leg_advanced_ = false;
  trail_.clear();
  state_ = State::kFollowing;
}

bool BoundaryFollower::seesNearerCell() {
  // Going straight, the distance falls until abreast of the goal and grows from there on.
  bool found = false;
  int fewest = 0;
  for (int direction = 0; direction < kGridRayCount; direction += 2) {
    const CellIndex step = kGridRaySteps[static_cast<std::size_t>(direction)];
    const int abreast = (now_.goal.column - now_.cell.column) * step.column + (now_.goal.row - now_.cell.row) * step.row;
    const int steps = std::min(abreast, now_.ranges[static_cast<std::size_t>(direction)] - 1);
    if (steps < 1 || (found && steps >= fewest)) continue;
    const CellIndex seen = {now_.cell.column + steps * step.column, now_.cell.row + steps * step.row};
    if (!(octileDistance(seen, now_.goal) < best_)) continue;
    found = true;
    fewest = steps;
    leaving_direction_ = direction;
  }
  if (found) state_ = State::kLeaving;
  return found;
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

int BoundaryFollower::directionAlong(End* end, std::vector<CellIndex>* beyond) const {
  *beyond = end->cells;
  if (!(octileDistance(end->edge.cell, now_.goal) < best_)) {
    const BoundaryStep step = nextAlongBoundary(now_, end->edge, end->side, parameters_.corner_cutting);
    if (step.kind == BoundaryStep::Kind::kUnseen && step.cell_count == 1) beyond->push_back(step.cells[0]);
  }
  for (std::size_t i = beyond->size(); i-- > 0;) {
    const int direction = directionBetween(now_.cell, (*beyond)[i]);
    if (direction == kNoWay || !movePossible(now_.ranges, direction, parameters_.corner_cutting)) continue;
    end->cells.erase(end->cells.begin(),
                     end->cells.begin() + static_cast<std::ptrdiff_t>(std::min(i + 1, end->cells.size())));
    return direction;
  }
  return kNoWay;
}

bool BoundaryFollower::shouldTurnBack() const {
  if (trail_.lost() || !leg_advanced_) return false;
  const double back = trail_.lengthTo(1 - end_, now_.cell);
  return leg_ > std::max(parameters_.first_leg, parameters_.leg_growth * back);
}

std::size_t BoundaryFollower::peakBytes() const {
  return sizeof(*this) + 2 * (kMostCells + 2) * sizeof(CellIndex) + trail_.peakBytes();
}

}  // namespace lstm_planner
