// What is passable by what is remembered; how that comes and goes is in obstacle_memory.cpp.

#include <algorithm>
#include <cmath>

#include "lstm_planner/base/grid/grid_rays.hpp"
#include "lstm_planner/robot/memory/obstacle_memory.hpp"
#include "robot/memory/whole_numbers.hpp"
#include "robot/perception/lanes.hpp"

namespace lstm_planner {

namespace {

/// Bit of a judgement.
constexpr std::uint8_t kExitsKnown = 0x40;

/// An obstacle matters within so many cells at most, or 64 squares side by side are not enough.
constexpr int kMostNearCells = 3;

}  // namespace

Point2 ObstacleMemory::bestPlace(int cell) { return centerOf(squareOf(cell, judgement(cell) & 0xf)); }

std::uint8_t ObstacleMemory::exits(int cell) {
  judgement(cell);
  const auto i = static_cast<std::size_t>(cell);
  if ((judged_[i] & kExitsKnown) == 0) {
    exits_[i] = judgeExits(cell);
    judged_[i] |= kExitsKnown;
  }
  return exits_[i];
}

bool ObstacleMemory::isFree(const Point2& from, const Point2& to, Passage passage_wanted) {
  const double wanted = passage_wanted == Passage::kRoomy    ? roomy_radius_
                        : passage_wanted == Passage::kNarrow ? narrow_radius_
                                                             : tight_radius_;
  const double radius = onTheWay(wanted);
  const double length = distanceBetween(from, to);
  const int parts = std::max(1, static_cast<int>(std::ceil(length / (2.0 * parameters_.resolution))));
  int empty = -1;  // a cell with nothing near
  for (int i = 0; i <= parts; ++i) {
    const double share = static_cast<double>(i) / parts;
    const Point2 at{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    const int cell = cellAt(at);
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

bool ObstacleMemory::isAnythingNear(int cell, int reach) const {
  constexpr int kWidest = 31;
  if (reach > kWidest) {
    return true;  // there may be, somewhere
  }
  const int column = cell % side_ - reach;
  const int row = cell / side_;
  std::uint64_t bits = 0;
  for (int r = std::max(0, row - reach); r <= std::min(side_ - 1, row + reach); ++r) bits |= cells_.from(column, r);
  return (bits & lowestBits(2 * reach + 1)) != 0 || isBlockNear(cell, reach);
}

bool ObstacleMemory::isBlockNear(int cell, int reach) const {
  if (blocks_.empty()) {
    return false;
  }
  const Point2 middle = centerOf(cell);
  return std::any_of(blocks_.begin(), blocks_.end(), [&](const Point2& block) {
    return distanceBetween(block, middle) < (reach + 1) * cell_size_;
  });
}

std::uint8_t ObstacleMemory::judge(int cell) const {
  if (!isAnythingNear(cell, near_cells_)) {
    return kNothingNear;
  }
  if (near_cells_ > kMostNearCells || isBlockNear(cell, near_cells_)) {
    return judgeAmongBlocks(cell);
  }
  int squared = 0;
  const int best_square = bestSquare(cell, &squared);
  return judgementOf(squared * parameters_.resolution * parameters_.resolution, best_square);
}

std::uint8_t ObstacleMemory::judgementOf(double squared, int best_square) const {
  const Passage passage = squared < tight_radius_ * tight_radius_     ? Passage::kBlocked
                          : squared < narrow_radius_ * narrow_radius_ ? Passage::kTight
                          : squared < roomy_radius_ * roomy_radius_   ? Passage::kNarrow
                                                                      : Passage::kRoomy;
  return static_cast<std::uint8_t>(static_cast<int>(passage) << 4 | best_square);
}

int ObstacleMemory::bestSquare(int cell, int* squared) const {
  static_assert(kSide == kLanes, "a row of squares side by side");
  constexpr int kFar = 1 << 20;
  // Beyond both ends a square is taken as occupied that is farther away than all that matter.
  constexpr int kMargin = 18;
  constexpr std::uint64_t kEnds = std::uint64_t{1} << 63 | 1;
  const Square first = squareOf(cell, 0);
  const int reach = kSide * near_cells_;
  const int width = 2 * reach + kSide;
  const int middle = kMargin + reach;
  Ints nearest[kSide] = {allOf(kFar), allOf(kFar), allOf(kFar), allOf(kFar)};
  for (int row = std::max(-reach, -first.row); row < std::min(reach + kSide, squares_.rows() - first.row); ++row) {
    const std::uint64_t occupied = squares_.from(first.column - reach, first.row + row) & lowestBits(width);
    if (occupied == 0) {
      continue;
    }
    const std::uint64_t bits = occupied << kMargin | kEnds;
    Ints columns;
    for (int i = 0; i < kSide; ++i) {
      const int left = middle + i - highestBit(bits & lowestBits(middle + i + 1));
      const int right = lowestBit(bits >> (middle + i));
      const int column = std::min(left, right);
      columns[i] = column * column;
    }
    for (int i = 0; i < kSide; ++i) {
      const Ints distances = columns + allOf((row - i) * (row - i));
      nearest[i] = distances < nearest[i] ? distances : nearest[i];
    }
  }
  int best = -1;
  *squared = -1;
  for (int square = 0; square < kCellSquares; ++square) {
    const int distance = nearest[square / kSide][square % kSide];
    if (distance > *squared) {
      *squared = distance;
      best = square;
    }
  }
  return best;
}

std::uint8_t ObstacleMemory::judgeExits(int cell) {
  const int column = cell % side_;
  const int row = cell / side_;
  if (column == 0 || row == 0 || column == side_ - 1 || row == side_ - 1) {
    return 0;
  }
  if (!isAnythingNear(cell, near_cells_ + 1)) {
    return 0xff;
  }
  if (passage(cell) == Passage::kBlocked) {
    return 0;
  }
  if (near_cells_ > kMostNearCells || isBlockNear(cell, near_cells_ + 1)) {
    return judgeExitsAmongBlocks(cell);
  }
  const Square from = squareOf(cell, judgement(cell) & 0xf);
  std::uint8_t exits = 0;
  for (std::size_t direction = 0; direction < kGridRaySteps.size(); ++direction) {
    const int neighbour = cell + kGridRaySteps[direction].row * side_ + kGridRaySteps[direction].column;
    if (passage(neighbour) != Passage::kBlocked && isLineFree(from, squareOf(neighbour, judgement(neighbour) & 0xf))) {
      exits = static_cast<std::uint8_t>(exits | 1u << direction);
    }
  }
  return exits;
}

bool ObstacleMemory::isLineFree(const Square& from, const Square& to) const {
  const Square& lower = from.row <= to.row ? from : to;
  const Square& upper = from.row <= to.row ? to : from;
  const std::uint64_t* mask = line_masks_.mask(upper.column - lower.column, upper.row - lower.row);
  const int left = std::min(lower.column, upper.column) - line_masks_.margin();
  const int bottom = lower.row - line_masks_.margin();
  const int last = std::min(squares_.rows() - 1, upper.row + line_masks_.margin());
  std::uint64_t met = 0;
  for (int row = std::max(0, bottom); row <= last; ++row) met |= squares_.from(left, row) & mask[row - bottom];
  return met == 0;
}

bool ObstacleMemory::isGapFree(const Point2& position, double radius) const {
  const auto isNear = [&](const Point2& block) { return distanceBetween(position, block) < radius; };
  if (std::any_of(blocks_.begin(), blocks_.end(), isNear)) {
    return false;
  }
  // In squares from the middle of the window's first one.
  const double scale = 1.0 / parameters_.resolution;
  const double x = position.x * scale - kSide * origin_column_ - 0.5;
  const double y = position.y * scale - kSide * origin_row_ - 0.5;
  const double reach = radius * scale;
  const int left = std::max(0, floorOf(x - reach));
  const int right = std::min(squares_.columns(), floorOf(x + reach) + 1);
  const int last = std::min(squares_.rows() - 1, floorOf(y + reach));
  for (int row = std::max(0, floorOf(y - reach)); row <= last; ++row) {
    for (int column = left; column < right; column += 64) {
      std::uint64_t bits = squares_.from(column, row) & lowestBits(std::min(64, right - column));
      for (; bits != 0; bits &= bits - 1) {
        const double dx = column + lowestBit(bits) - x;
        const double dy = row - y;
        if (dx * dx + dy * dy < reach * reach) {
          return false;
        }
      }
    }
  }
  return true;
}

void ObstacleMemory::setTightRadius(double radius) {
  tight_radius_ = radius;
  if (near_cells_ <= kMostNearCells) {
    line_masks_.setRadius(onTheWay(radius) / parameters_.resolution);
  }
}

}  // namespace lstm_planner
