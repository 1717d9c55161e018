// What is remembered, in a window that moves along; what a scan changes is in obstacle_memory_look.cpp, what is
// passable in obstacle_memory_passages.cpp.

#include "lstm_planner/robot/memory/obstacle_memory.hpp"

#include <algorithm>
#include <cmath>

#include "robot/memory/whole_numbers.hpp"

namespace lstm_planner {

namespace {

/// Places that are kept as blocked; the oldest gives way.
constexpr std::size_t kMostBlocks = 32;

/// More changes than this between two looks at them count as everything.
constexpr std::size_t kMostChanges = 1024;

/// From the middle of a cell to the middle of its corner squares, in squares.
const double kCorner = std::hypot(1.5, 1.5);

/// Ways from one best place to the next lead over so many rows or columns of squares at most.
constexpr int kLongestLine = 2 * ObstacleMemory::kSide - 1;

}  // namespace

ObstacleMemory::ObstacleMemory(const MemoryParameters& parameters, const ShieldParameters& shield)
    : parameters_(parameters),
      side_(static_cast<int>(std::ceil(parameters.width / (kSide * parameters.resolution)))),
      cell_size_(kSide * parameters.resolution),
      footprint_radius_(shield.footprint_radius),
      tight_clearance_(shield.tight_clearance),
      narrow_radius_(shield.footprint_radius + shield.clearance + 0.5 * parameters.resolution),
      roomy_radius_(std::max(shield.footprint_radius + parameters.comfort, narrow_radius_)),
      near_cells_(static_cast<int>(std::ceil(roomy_radius_ / cell_size_))),
      squares_(kSide * side_, kSide * side_),
      cells_(side_, side_),
      line_masks_(kLongestLine),
      sight_(kCorner * parameters.resolution) {
  const auto cells = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  judged_.resize(cells);
  exits_.resize(cells);
  blocks_.reserve(kMostBlocks);
  changes_.reserve(kMostChanges);
  seen_through_.reserve(kMostChanges);
  setTightRadius(footprint_radius_ + 0.5 * tight_clearance_);
  forget();
}

void ObstacleMemory::forget() {
  placed_ = false;
  squares_.clear();
  cells_.clear();
  blocks_.clear();
  outdateAll();
}

void ObstacleMemory::clearChanges() {
  changes_.clear();
  everything_changed_ = false;
}

void ObstacleMemory::noteChange(const Point2& place, bool occupied) {
  if (changes_.size() < kMostChanges) {
    changes_.push_back({place, occupied});
  } else {
    everything_changed_ = true;
  }
}

void ObstacleMemory::block(const Point2& place) {
  const auto change = [&](const Point2& block, bool occupied) {
    noteChange(block, occupied);
    const int cell = cellAt(block);
    if (cell >= 0) {
      outdated_ = -1;
      outdate(cell);
    }
  };
  if (blocks_.size() == kMostBlocks) {
    change(blocks_.front(), false);
    blocks_.erase(blocks_.begin());
  }
  blocks_.push_back(place);
  change(place, true);
}

void ObstacleMemory::squeeze(bool on) {
  const double radius = footprint_radius_ + (on ? -0.5 * parameters_.resolution : 0.5 * tight_clearance_);
  if (radius != tight_radius_) {
    setTightRadius(radius);
    outdateAll();
  }
}

int ObstacleMemory::cellAt(const Point2& position) const {
  const int column = floorOf(position.x / cell_size_) - origin_column_;
  const int row = floorOf(position.y / cell_size_) - origin_row_;
  return column < 0 || row < 0 || column >= side_ || row >= side_ ? -1 : row * side_ + column;
}

Point2 ObstacleMemory::centerOf(int cell) const {
  return {(origin_column_ + cell % side_ + 0.5) * cell_size_, (origin_row_ + cell / side_ + 0.5) * cell_size_};
}

ObstacleMemory::Square ObstacleMemory::squareAt(const Point2& position) const {
  return {floorOf(position.x / parameters_.resolution), floorOf(position.y / parameters_.resolution)};
}

void ObstacleMemory::moveWindow(const Pose2& pose) {
  const int column = floorOf(pose.x / cell_size_) - side_ / 2;
  const int row = floorOf(pose.y / cell_size_) - side_ / 2;
  const int right = std::clamp(column - origin_column_, -side_, side_);
  const int up = std::clamp(row - origin_row_, -side_, side_);
  if (placed_ && std::max(std::abs(right), std::abs(up)) <= side_ / 8) {
    return;
  }
  if (placed_) {
    squares_.move(kSide * right, kSide * up);
    cells_.move(right, up);
  }
  origin_column_ = column;
  origin_row_ = row;
  placed_ = true;
  outdateAll();
}

void ObstacleMemory::forgetUnderneath(const Pose2& pose) {
  const Square here = squareAt({pose.x, pose.y});
  const int squares = static_cast<int>(footprint_radius_ / parameters_.resolution);
  for (int row = -squares; row <= squares; ++row) {
    for (int column = -squares; column <= squares; ++column) {
      const Square square{here.column + column - kSide * origin_column_, here.row + row - kSide * origin_row_};
      if (square.column >= 0 && square.column < squares_.columns() && square.row >= 0 &&
          square.row < squares_.rows() && squares_.test(square.column, square.row) &&
          distanceBetween(centerOf(square), pose) < 0.9 * footprint_radius_) {
        set(square, false);
      }
    }
  }
}

void ObstacleMemory::set(const Square& square, bool occupied) {
  const int column = square.column / kSide;
  const int row = square.row / kSide;
  if (occupied) {
    squares_.set(square.column, square.row);
    cells_.set(column, row);
  } else {
    squares_.reset(square.column, square.row);
    std::uint64_t others = 0;
    for (int r = row * kSide; r < (row + 1) * kSide; ++r) others |= squares_.from(column * kSide, r);
    if ((others & lowestBits(kSide)) == 0) {
      cells_.reset(column, row);
    }
  }
  outdate(row * side_ + column);
  noteChange(centerOf(square), occupied);
}

void ObstacleMemory::outdate(int cell) {
  if (cell == outdated_) {
    return;
  }
  outdated_ = cell;
  const int column = cell % side_;
  const int row = cell / side_;
  const int reach = near_cells_ + 1;  // the exits depend on the neighbours, too
  const int first = std::max(0, column - reach);
  const int last = std::min(side_ - 1, column + reach);
  for (int r = std::max(0, row - reach); r <= std::min(side_ - 1, row + reach); ++r) {
    for (int c = first; c <= last; ++c) judged_[static_cast<std::size_t>(r * side_ + c)] = kUnknown;
  }
}

void ObstacleMemory::outdateAll() {
  std::fill(judged_.begin(), judged_.end(), kUnknown);
  everything_changed_ = true;
}

}  // namespace lstm_planner
