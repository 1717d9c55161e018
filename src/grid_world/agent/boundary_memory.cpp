#include "lstm_planner/grid_world/agent/boundary_memory.hpp"

#include <cmath>

#include "lstm_planner/grid_world/agent/nearer_cell.hpp"

namespace lstm_planner {
namespace {

/// 1: to the left.
int turnTo(WallSide hand) { return hand == WallSide::kLeft ? 1 : -1; }

/// The first possible move from a direction on, turning by `turn`.
int firstPossible(const GridRanges& ranges, int from, int turn, CornerCutting corner_cutting) {
  for (int i = 0; i < kGridMoveCount; ++i) {
    const int direction = turned(from, i * turn);
    if (movePossible(ranges, direction, corner_cutting)) return direction;
  }
  return kNoPath;
}

/// The impossible move nearest to a direction, of two first the one to the side of `turn`.
int nearestImpossible(const GridRanges& ranges, int direction, int turn, CornerCutting corner_cutting) {
  for (int i = 0; i <= kGridMoveCount / 2; ++i) {
    for (const int side : {turn, -turn}) {
      const int candidate = turned(direction, side * i);
      if (!movePossible(ranges, candidate, corner_cutting)) return candidate;
    }
  }
  return kNoPath;
}

int directionNearestTo(CellIndex from, CellIndex to) {
  const double angle = std::atan2(to.row - from.row, to.column - from.column);
  return turned(0, static_cast<int>(std::lround(angle / M_PI_4)));
}

}  // namespace

BoundaryMemory::BoundaryMemory(CornerCutting corner_cutting)
    : corner_cutting_(corner_cutting), trail_(corner_cutting) {}

void BoundaryMemory::observe(const GridObservation& observation) {
  const GridObservation before = now_;
  now_ = observation;
  const bool same_goal = observation.goal == before.goal;
  if (started_ && same_goal && observation.cell == before.cell) return;
  const int move = started_ && same_goal ? rayBetween(before.cell, observation.cell) : kNoPath;
  const OctileDistance distance = octileDistance(observation.cell, observation.goal);
  if (move == kNoPath || distance < best_) {
    started_ = true;
    best_ = distance;
    startHere();
  } else {
    noteMove(move);
  }
  previous_move_ = move;
  noteHands();
  for (int end = 0; end < 2; ++end) {
    const bool leads = !trail_.lost() && !trail_.atEnd(end);
    to_ends_[static_cast<std::size_t>(end)] = leads ? trail_.directionTo(end, now_.cell) : kNoPath;
  }
}

void BoundaryMemory::startHere() {
  hand_.reset();
  returning_ = has_returned_ = false;
  leg_ = path_back_ = 0.0;
  ends_.fill({now_.cell, kNoPath});
  trail_.clear();
}

/// A move that brought the agent no nearer to the goal than ever before. It keeps to its end or its trail as long as it
/// does not leave for the other end.
void BoundaryMemory::noteMove(int move) {
  if (!hand_) {
    const bool only_right = move == directionByHand(WallSide::kRight) && move != directionByHand(WallSide::kLeft);
    hand_ = only_right ? WallSide::kRight : WallSide::kLeft;
  } else {
    const int ahead = returning_ ? directionToEnd(*hand_) : directionByHand(*hand_);
    if (move != ahead && move == directionToEnd(opposite(*hand_))) {
      hand_ = opposite(*hand_);
      returning_ = true;
      leg_ = 0.0;
    }
  }
  leg_ += moveLength(move);
  const int end = static_cast<int>(indexOf(*hand_));
  trail_.moved(cellBeside(now_.cell, turned(move, 4)), now_, returning_ ? -1 : end);
  has_returned_ = returning_ && (trail_.lost() || trail_.atEnd(end));
  if (!has_returned_) return;
  returning_ = false;
  leg_ = 0.0;
  path_back_ = lengthToEnd(opposite(*hand_));
}

void BoundaryMemory::noteHands() {
  by_hand_.fill(kNoPath);
  const int wall = wallHere();
  if (wall == kNoPath) return;
  for (const WallSide hand : {WallSide::kRight, WallSide::kLeft}) {
    const int turn = -turnTo(hand);
    by_hand_[indexOf(hand)] = firstPossible(now_.ranges, turned(wall, turn), turn, corner_cutting_);
  }
  if (!hand_) {
    ends_.fill({now_.cell, wall});
  } else if (!returning_) {
    ends_[indexOf(*hand_)] = {now_.cell, wall};
  }
}

/// The direction of the obstacle that is followed.
int BoundaryMemory::wallHere() const {
  if (hand_ && !has_returned_) return wallBeside();
  const int wall = hand_ ? ends_[indexOf(*hand_)].wall : directionOfObstacle(now_);
  if (wall == kNoPath || !movePossible(now_.ranges, wall, corner_cutting_)) return wall;
  const int towards = hand_ ? wall : directionNearestTo(now_.cell, now_.goal);
  return nearestImpossible(now_.ranges, towards, 1, corner_cutting_);
}

/// The obstacle at the hand, as seen from the last move on: where the hand would first get past it, or the nearest one.
int BoundaryMemory::wallBeside() const {
  const int turn = turnTo(*hand_);
  const int at_hand = turned(previous_move_, 3 * turn);
  if (movePossible(now_.ranges, at_hand, corner_cutting_)) {
    return nearestImpossible(now_.ranges, turned(previous_move_, 2 * turn), turn, corner_cutting_);
  }
  const int next = firstPossible(now_.ranges, at_hand, -turn, corner_cutting_);
  return next == kNoPath ? kNoPath : turned(next, turn);
}

double BoundaryMemory::lengthToEnd(WallSide hand) const {
  return trail_.lost() ? 0.0 : trail_.lengthTo(static_cast<int>(indexOf(hand)), now_.cell);
}

double BoundaryMemory::otherEndFarther() const {
  if (!hand_) return 0.0;
  const CellIndex other = ends_[indexOf(opposite(*hand_))].cell;
  return octileDistance(other, now_.goal).length() - octileDistance(now_.cell, now_.goal).length();
}

}  // namespace lstm_planner
