#include "lstm_planner/drive/local_map/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drive/local_map/bounded_rounding.hpp"
#include "lstm_planner/common/segment.hpp"
#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

namespace {

/// Bit of a judgement.
constexpr std::uint8_t kExitsKnown = 0x40;

/// Places that are kept as blocked; the oldest gives way.
constexpr std::size_t kMostBlocks = 32;

/// In squares.
Point2 pointOf(const Square& square) { return {static_cast<double>(square.column), static_cast<double>(square.row)}; }

/// m from the middle of the robot to an obstacle beside which it drives as it likes: also turns, if it has corners.
double narrowRadius(const ShieldParameters& shield) {
  return std::max(shield.footprint_radius + shield.clearance,
                  footprintOf(shield).circumscribedRadius() + shield.tight_clearance);
}

}  // namespace

Clearance::Clearance(const MemoryParameters& parameters, const ShieldParameters& shield)
    : window_(parameters.width, parameters.resolution),
      footprint_radius_(shield.footprint_radius),
      tight_clearance_(shield.tight_clearance),
      tight_radius_(footprint_radius_ + 0.5 * tight_clearance_),
      narrow_radius_(narrowRadius(shield) + 0.5 * window_.resolution()),
      roomy_radius_(std::max(shield.footprint_radius + parameters.comfort, narrow_radius_)),
      near_cells_(static_cast<int>(std::ceil(roomy_radius_ / window_.cellSize()))) {
  const auto cells = static_cast<std::size_t>(window_.side()) * static_cast<std::size_t>(window_.side());
  judged_.resize(cells, kUnknown);
  exits_.resize(cells);
  blocks_.reserve(kMostBlocks);
}

void Clearance::forget() {
  window_.clear();
  blocks_.clear();
  outdateAll();
}

bool Clearance::moveTo(const Pose2& pose) {
  const bool has_moved = window_.moveTo(pose);
  if (has_moved) outdateAll();
  return has_moved;
}

void Clearance::block(const Point2& place) {
  if (blocks_.size() == kMostBlocks) {
    outdateAt(blocks_.front());
    blocks_.erase(blocks_.begin());
  }
  blocks_.push_back(place);
  outdateAt(place);
}

void Clearance::unblock(const Point2& place) {
  const auto isIt = [&](const Point2& block) { return block.x == place.x && block.y == place.y; };
  const auto block = std::find_if(blocks_.begin(), blocks_.end(), isIt);
  if (block == blocks_.end()) return;
  blocks_.erase(block);
  outdateAt(place);
}

void Clearance::unblockAll() {
  for (const Point2& block : blocks_) outdateAt(block);
  blocks_.clear();
}

void Clearance::relaxClearance(bool on) {
  const double radius = footprint_radius_ + (on ? -0.5 * window_.resolution() : 0.5 * tight_clearance_);
  if (radius == tight_radius_) return;
  tight_radius_ = radius;
  outdateAll();
}

void Clearance::outdateAt(const Point2& place) {
  if (const int cell = window_.cellAt(place); cell >= 0) outdate(cell);
}

void Clearance::outdate(int cell) {
  const int column = cell % window_.side();
  const int row = cell / window_.side();
  const int reach = near_cells_ + 1;  // the exits depend on the neighbours, too
  const int first = std::max(0, column - reach);
  const int last = std::min(window_.side() - 1, column + reach);
  for (int r = std::max(0, row - reach); r <= std::min(window_.side() - 1, row + reach); ++r) {
    for (int c = first; c <= last; ++c) judged_[static_cast<std::size_t>(r * window_.side() + c)] = kUnknown;
  }
}

void Clearance::outdateAll() { std::fill(judged_.begin(), judged_.end(), kUnknown); }

std::uint8_t Clearance::exits(int cell) {
  judgement(cell);
  const auto i = static_cast<std::size_t>(cell);
  if ((judged_[i] & kExitsKnown) == 0) {
    exits_[i] = judgeExits(cell);
    judged_[i] |= kExitsKnown;
  }
  return exits_[i];
}

bool Clearance::isFree(const Point2& from, const Point2& to, Passage wanted_passage) const {
  const double wanted = wanted_passage == Passage::kRoomy    ? roomy_radius_
                        : wanted_passage == Passage::kNarrow ? narrow_radius_
                                                             : tight_radius_;
  const double radius = onThePath(wanted);
  const double length = distanceBetween(from, to);
  const int parts = std::max(1, static_cast<int>(std::ceil(length / (2.0 * window_.resolution()))));
  int empty = -1;  // a cell with nothing near
  for (int i = 0; i <= parts; ++i) {
    const double share = static_cast<double>(i) / parts;
    const Point2 at{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    const int cell = window_.cellAt(at);
    if (cell < 0) {
      return false;
    }
    if (cell == empty) {
      continue;
    }
    if (!isAnythingNear(cell, near_cells_)) {
      empty = cell;
    } else if (!isGapFree(at, radius)) {
      return false;
    }
  }
  return true;
}

bool Clearance::isAnythingNear(int cell, int reach) const {
  constexpr int kWidest = 31;
  if (reach > kWidest) {
    return true;  // there may be, somewhere
  }
  const int column = cell % window_.side() - reach;
  const int row = cell / window_.side();
  std::uint64_t bits = 0;
  for (int r = std::max(0, row - reach); r <= std::min(window_.side() - 1, row + reach); ++r)
    bits |= window_.cells().from(column, r);
  return (bits & lowestBits(2 * reach + 1)) != 0 || isBlockNear(cell, reach);
}

bool Clearance::isBlockNear(int cell, int reach) const {
  if (blocks_.empty()) {
    return false;
  }
  const Point2 middle = window_.centerOf(cell);
  return std::any_of(blocks_.begin(), blocks_.end(), [&](const Point2& block) {
    return distanceBetween(block, middle) < (reach + 1) * window_.cellSize();
  });
}

std::uint8_t Clearance::judge(int cell) {
  if (!isAnythingNear(cell, near_cells_)) {
    return kNothingNear;
  }
  collectNearby(cell, near_cells_);
  int best_square = 0;
  double squared = -1.0;
  for (int square = 0; square < ObstacleWindow::kCellSquares; ++square) {
    const double here = squaredClearance(window_.squareOf(cell, square));
    if (here <= squared) continue;
    squared = here;
    best_square = square;
  }
  const Passage passage = squared < tight_radius_ * tight_radius_     ? Passage::kBlocked
                          : squared < narrow_radius_ * narrow_radius_ ? Passage::kTight
                          : squared < roomy_radius_ * roomy_radius_   ? Passage::kNarrow
                                                                      : Passage::kRoomy;
  return static_cast<std::uint8_t>(static_cast<int>(passage) << 4 | best_square);
}

std::uint8_t Clearance::judgeExits(int cell) {
  if (window_.isAtBorder(cell)) {
    return 0;
  }
  if (!isAnythingNear(cell, near_cells_ + 1)) {
    return 0xff;
  }
  if (passage(cell) == Passage::kBlocked) {
    return 0;
  }
  const auto neighbourOf = [&](const CellIndex& step) { return cell + step.row * window_.side() + step.column; };
  // Before others are collected than here.
  for (const CellIndex& step : kGridRaySteps) judgement(neighbourOf(step));
  collectNearby(cell, near_cells_ + 1);
  const auto bestSquareOf = [&](int of) { return window_.squareOf(of, judgement(of) & 0xf); };
  std::uint8_t exits = 0;
  for (std::size_t direction = 0; direction < kGridRaySteps.size(); ++direction) {
    const int neighbour = neighbourOf(kGridRaySteps[direction]);
    if (passage(neighbour) != Passage::kBlocked && isLineFree(bestSquareOf(cell), bestSquareOf(neighbour))) {
      exits = static_cast<std::uint8_t>(exits | 1u << direction);
    }
  }
  return exits;
}

void Clearance::collectNearby(int cell, int reach) {
  nearby_.clear();
  const Square first = window_.squareOf(cell, 0);
  const int around = kSide * reach;
  window_.visitOccupied({first.column - around, first.row - around},
                        {first.column + kSide - 1 + around, first.row + kSide - 1 + around}, [&](const Square& square) {
                          nearby_.push_back(square);
                          return false;
                        });
}

double Clearance::squaredClearance(const Square& square) const {
  int squares = std::numeric_limits<int>::max();
  for (const Square& other : nearby_) {
    const int columns = other.column - square.column;
    const int rows = other.row - square.row;
    squares = std::min(squares, columns * columns + rows * rows);
  }
  double squared = squares * window_.resolution() * window_.resolution();
  for (const Point2& block : blocks_) {
    const double distance = distanceBetween(block, window_.centerOf(square));
    squared = std::min(squared, distance * distance);
  }
  return squared;
}

bool Clearance::isLineFree(const Square& from, const Square& to) const {
  const Square& lower = from.row <= to.row ? from : to;
  const Square& upper = from.row <= to.row ? to : from;
  const double radius = onThePath(tight_radius_);
  const double squares = radius / window_.resolution();
  const auto isBeside = [&](const Square& obstacle) {
    return squaredDistanceToSegment(pointOf(obstacle), pointOf(lower), pointOf(upper)) < squares * squares;
  };
  const auto blocks = [&](const Point2& block) {
    return squaredDistanceToSegment(block, window_.centerOf(from), window_.centerOf(to)) < radius * radius;
  };
  return std::none_of(nearby_.begin(), nearby_.end(), isBeside) && std::none_of(blocks_.begin(), blocks_.end(), blocks);
}

bool Clearance::isGapFree(const Point2& position, double radius) const {
  const auto isNear = [&](const Point2& block) { return distanceBetween(position, block) < radius; };
  if (std::any_of(blocks_.begin(), blocks_.end(), isNear)) {
    return false;
  }
  // In squares from the middle of the window's first one.
  const double scale = 1.0 / window_.resolution();
  const double x = position.x * scale - window_.origin().column - 0.5;
  const double y = position.y * scale - window_.origin().row - 0.5;
  const double reach = radius * scale;
  bool is_free = true;
  window_.visitOccupied({floorOf(x - reach), floorOf(y - reach)}, {floorOf(x + reach), floorOf(y + reach)},
                        [&](const Square& at) {
                          is_free = square(at.column - x) + square(at.row - y) >= reach * reach;
                          return !is_free;
                        });
  return is_free;
}

}  // namespace lstm_planner
