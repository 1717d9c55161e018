#include "lstm_planner/drive/local_map/local_map.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {

namespace {

/// Nearer to the middle of the robot than this, in footprint radii, nothing else can be.
constexpr double kUnderneath = 0.9;

}  // namespace

LocalMap::LocalMap(const MemoryParameters& parameters, const ShieldParameters& shield)
    : footprint_radius_(footprintOf(shield).inscribedRadius()),
      clearance_(parameters, shield),
      scan_changes_(parameters.reach),
      reach_(parameters.reach) {
  forget();
}

void LocalMap::forget() {
  clearance_.forget();
  marks_.clear();
}

void LocalMap::add(const Situation& situation) {
  if (!isInReach(situation.pose)) {
    return;
  }
  if (clearance_.moveTo(situation.pose)) markKnown();
  takeOverMarks(situation);
  scan_changes_.find(situation, window());
  for (const std::uint32_t key : scan_changes_.cleared()) {
    if (!isMarked(squareOf(key))) clearance_.set(squareOf(key), false);
  }
  for (const std::uint32_t key : scan_changes_.returns()) {
    const Square square = squareOf(key);
    if (!window().isOccupied(square)) {
      clearance_.set(square, true);
    }
  }
  // Where the robot stands nothing else can be.
  forgetUnderneath(situation.pose);
}

void LocalMap::markKnown() {
  for (const Point2& place : known_) {
    const Square square = window().squareAt(place);
    if (window().contains(square)) clearance_.set(square, true);
  }
}

void LocalMap::takeOverMarks(const Situation& situation) {
  if (situation.marked.empty() && marks_.empty()) return;
  collectMarks(situation);
  for (const Mark mark : marks_) {
    const Square square = squareOfMark(mark);
    if (window().contains(square) && !std::binary_search(marked_.begin(), marked_.end(), mark))
      clearance_.set(square, false);
  }
  marks_.swap(marked_);
  for (const Mark mark : marks_) {
    const Square square = squareOfMark(mark);
    if (!window().isOccupied(square)) clearance_.set(square, true);
  }
}

void LocalMap::collectMarks(const Situation& situation) {
  marked_.clear();
  for (const Point2& place : situation.marked) {
    if (std::hypot(place.x, place.y) > reach_) continue;
    const Square square = window().squareAt(toParentFrame(situation.pose, place));
    const bool is_underneath = window().contains(square) && distanceBetween(window().centerOf(square), situation.pose) <
                                                                kUnderneath * footprint_radius_;
    if (window().contains(square) && !is_underneath && !isSeenBeside(square)) marked_.push_back(markAt(square));
  }
  std::sort(marked_.begin(), marked_.end());
  marked_.erase(std::unique(marked_.begin(), marked_.end()), marked_.end());
}

bool LocalMap::isSeenBeside(const Square& square) const {
  for (int row = square.row - 1; row <= square.row + 1; ++row) {
    for (int column = square.column - 1; column <= square.column + 1; ++column) {
      const Square beside{column, row};
      if (window().contains(beside) && window().isOccupied(beside) && !isMarked(beside)) return true;
    }
  }
  return false;
}

bool LocalMap::isMarked(const Square& square) const {
  return !marks_.empty() && std::binary_search(marks_.begin(), marks_.end(), markAt(square));
}

LocalMap::Mark LocalMap::markAt(const Square& square) const {
  const auto column = static_cast<std::uint32_t>(square.column + window().origin().column);
  const auto row = static_cast<std::uint32_t>(square.row + window().origin().row);
  return static_cast<Mark>(row) << 32 | column;
}

Square LocalMap::squareOfMark(Mark mark) const {
  return {static_cast<int>(static_cast<std::uint32_t>(mark)) - window().origin().column,
          static_cast<int>(static_cast<std::uint32_t>(mark >> 32)) - window().origin().row};
}

void LocalMap::forgetUnderneath(const Pose2& pose) {
  const Square here = window().squareAt({pose.x, pose.y});
  const int squares = static_cast<int>(footprint_radius_ / window().resolution());
  for (int row = -squares; row <= squares; ++row) {
    for (int column = -squares; column <= squares; ++column) {
      const Square square{here.column + column, here.row + row};
      if (window().contains(square) && window().isOccupied(square) &&
          distanceBetween(window().centerOf(square), pose) < kUnderneath * footprint_radius_) {
        clearance_.set(square, false);
      }
    }
  }
}

}  // namespace lstm_planner
