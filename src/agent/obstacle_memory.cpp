#include "lstm_planner/agent/obstacle_memory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lstm_planner {

namespace {

/// Places that are kept as blocked; the oldest gives way.
constexpr std::size_t kMostBlocks = 32;

/// More changes than this between two looks at them count as everything.
constexpr std::size_t kMostChanges = 2048;

/// A square is seen through when the beams towards it and beside it end this much behind it, m: noise and beams that
/// graze a wall must not take it away.
constexpr double kBehind = 0.1;
constexpr long kBeamsBeside = 2;

/// The nearest that any of a few neighbouring beams sees; 0 when one of them knows nothing.
float nearestRange(const RangeProfile& profile, long beam) {
  const long last = static_cast<long>(profile.ranges.size()) - 1;
  float nearest = std::numeric_limits<float>::infinity();
  for (long i = std::max(0L, beam - kBeamsBeside); i <= std::min(last, beam + kBeamsBeside); ++i) {
    nearest = std::min(nearest, profile.ranges[static_cast<std::size_t>(i)]);
  }
  return nearest;
}

}  // namespace

ObstacleMemory::ObstacleMemory(const MemoryParameters& parameters, const ShieldParameters& shield)
    : parameters_(parameters),
      side_(static_cast<int>(std::ceil(parameters.width / (kSide * parameters.resolution)))),
      cell_size_(kSide * parameters.resolution),
      footprint_radius_(shield.footprint_radius),
      tight_clearance_(shield.tight_clearance),
      tight_radius_(shield.footprint_radius + 0.5 * shield.tight_clearance),
      narrow_radius_(shield.footprint_radius + shield.clearance + 0.5 * parameters.resolution),
      roomy_radius_(std::max(shield.footprint_radius + parameters.comfort, narrow_radius_)),
      near_cells_(static_cast<int>(std::ceil(roomy_radius_ / cell_size_))) {
  const auto cells = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  occupied_.resize(cells);
  judged_.resize(cells);
  exits_.resize(cells);
  blocks_.reserve(kMostBlocks);
  changes_.reserve(kMostChanges);
  forget();
}

void ObstacleMemory::forget() {
  placed_ = false;
  std::fill(occupied_.begin(), occupied_.end(), std::uint16_t{0});
  std::fill(judged_.begin(), judged_.end(), kUnknown);
  blocks_.clear();
  everything_changed_ = true;
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

void ObstacleMemory::look(const Situation& situation) {
  if (!isFinite(situation.pose)) {
    return;
  }
  moveWindow(situation.pose);
  forgetSeenThrough(situation);
  const double reach = parameters_.reach;
  for (const Point2& obstacle : situation.obstacles) {
    if (obstacle.x * obstacle.x + obstacle.y * obstacle.y <= reach * reach) {
      set(squareAt(toParentFrame(situation.pose, obstacle)), true);
    }
  }
  // Where the robot stands nothing else can be.
  const Square here = squareAt({situation.pose.x, situation.pose.y});
  const int squares = static_cast<int>(footprint_radius_ / parameters_.resolution);
  for (int row = here.row - squares; row <= here.row + squares; ++row) {
    for (int column = here.column - squares; column <= here.column + squares; ++column) {
      if (distanceBetween(centerOf({column, row}), situation.pose) < 0.9 * footprint_radius_) {
        set({column, row}, false);
      }
    }
  }
}

void ObstacleMemory::block(const Point2& place) {
  if (blocks_.size() == kMostBlocks) {
    outdate(squareAt(blocks_.front()));
    noteChange(blocks_.front(), false);
    blocks_.erase(blocks_.begin());
  }
  blocks_.push_back(place);
  noteChange(place, true);
  outdate(squareAt(place));
}

void ObstacleMemory::squeeze(bool on) {
  const double radius = footprint_radius_ + (on ? -0.5 * parameters_.resolution : 0.5 * tight_clearance_);
  if (radius != tight_radius_) {
    tight_radius_ = radius;
    everything_changed_ = true;
    std::fill(judged_.begin(), judged_.end(), kUnknown);
  }
}

int ObstacleMemory::cellAt(const Point2& position) const {
  const int column = static_cast<int>(std::floor(position.x / cell_size_)) - origin_column_;
  const int row = static_cast<int>(std::floor(position.y / cell_size_)) - origin_row_;
  return column < 0 || row < 0 || column >= side_ || row >= side_ ? -1 : row * side_ + column;
}

Point2 ObstacleMemory::centerOf(int cell) const {
  return {(origin_column_ + cell % side_ + 0.5) * cell_size_, (origin_row_ + cell / side_ + 0.5) * cell_size_};
}

ObstacleMemory::Square ObstacleMemory::squareAt(const Point2& position) const {
  return {static_cast<int>(std::floor(position.x / parameters_.resolution)),
          static_cast<int>(std::floor(position.y / parameters_.resolution))};
}

ObstacleMemory::Square ObstacleMemory::squareOf(int cell, int square) const {
  return {(origin_column_ + cell % side_) * kSide + square % kSide,
          (origin_row_ + cell / side_) * kSide + square / kSide};
}

Point2 ObstacleMemory::centerOf(const Square& square) const {
  return {(square.column + 0.5) * parameters_.resolution, (square.row + 0.5) * parameters_.resolution};
}

void ObstacleMemory::moveWindow(const Pose2& pose) {
  const int column = static_cast<int>(std::floor(pose.x / cell_size_)) - side_ / 2;
  const int row = static_cast<int>(std::floor(pose.y / cell_size_)) - side_ / 2;
  if (placed_ && std::max(std::abs(column - origin_column_), std::abs(row - origin_row_)) <= side_ / 8) {
    return;
  }
  if (placed_) {
    const std::vector<std::uint16_t> before = occupied_;
    std::fill(occupied_.begin(), occupied_.end(), std::uint16_t{0});
    const int right = column - origin_column_;
    const int up = row - origin_row_;
    for (int to_row = std::max(0, -up); to_row < std::min(side_, side_ - up); ++to_row) {
      for (int to_column = std::max(0, -right); to_column < std::min(side_, side_ - right); ++to_column) {
        occupied_[static_cast<std::size_t>(to_row * side_ + to_column)] =
            before[static_cast<std::size_t>((to_row + up) * side_ + to_column + right)];
      }
    }
    std::fill(judged_.begin(), judged_.end(), kUnknown);
  }
  origin_column_ = column;
  origin_row_ = row;
  placed_ = true;
  everything_changed_ = true;
}

void ObstacleMemory::forgetSeenThrough(const Situation& situation) {
  const RangeProfile& profile = situation.profile;
  if (profile.ranges.empty()) {
    return;
  }
  const Point2 scanner = toParentFrame(situation.pose, profile.origin);
  const int reach = static_cast<int>(parameters_.reach / cell_size_);
  const int middle_column = static_cast<int>(std::floor(scanner.x / cell_size_)) - origin_column_;
  const int middle_row = static_cast<int>(std::floor(scanner.y / cell_size_)) - origin_row_;
  for (int row = std::max(0, middle_row - reach); row <= std::min(side_ - 1, middle_row + reach); ++row) {
    for (int column = std::max(0, middle_column - reach); column <= std::min(side_ - 1, middle_column + reach);
         ++column) {
      const int cell = row * side_ + column;
      const std::uint16_t mask = occupied_[static_cast<std::size_t>(cell)];
      for (int bit = 0; mask >> bit != 0; ++bit) {
        if ((mask >> bit & 1) == 0) {
          continue;
        }
        const Square square = squareOf(cell, bit);
        const Point2 center = centerOf(square);
        const long beam = profile.beamTowards(directionTo(scanner, center) - situation.pose.yaw);
        if (beam >= 0 && nearestRange(profile, beam) > distanceBetween(scanner, center) + kBehind) {
          set(square, false);
        }
      }
    }
  }
}

void ObstacleMemory::set(const Square& square, bool occupied) {
  const int cell = cellAt(centerOf(square));
  if (cell < 0) {
    return;
  }
  const int bit = (square.row & (kSide - 1)) * kSide + (square.column & (kSide - 1));
  std::uint16_t& mask = occupied_[static_cast<std::size_t>(cell)];
  const auto changed =
      static_cast<std::uint16_t>(occupied ? mask | 1u << bit : mask & ~(1u << bit));
  if (changed != mask) {
    mask = changed;
    outdate(square);
    noteChange(centerOf(square), occupied);
  }
}

void ObstacleMemory::outdate(const Square& square) {
  const int cell = cellAt(centerOf(square));
  if (cell < 0) {
    return;
  }
  const int column = cell % side_;
  const int row = cell / side_;
  const int reach = near_cells_ + 1;  // the exits depend on the neighbours, too
  for (int r = std::max(0, row - reach); r <= std::min(side_ - 1, row + reach); ++r) {
    const int first = std::max(0, column - reach);
    const int last = std::min(side_ - 1, column + reach);
    std::fill(judged_.begin() + r * side_ + first, judged_.begin() + r * side_ + last + 1, kUnknown);
  }
}

}  // namespace lstm_planner
