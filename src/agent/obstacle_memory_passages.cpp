// What is passable by what is remembered; how that comes and goes is in obstacle_memory.cpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lstm_planner/agent/obstacle_memory.hpp"
#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

namespace {

/// Bits of a judgement.
constexpr std::uint8_t kNothingNear = 0x80;
constexpr std::uint8_t kExitsKnown = 0x40;

double squaredDistanceToLine(const Point2& point, const Point2& from, const Point2& to) {
  const Point2 line{to.x - from.x, to.y - from.y};
  const Point2 off{point.x - from.x, point.y - from.y};
  const double length = line.x * line.x + line.y * line.y;
  const double share = length > 0.0 ? std::clamp((off.x * line.x + off.y * line.y) / length, 0.0, 1.0) : 0.0;
  const double dx = off.x - share * line.x;
  const double dy = off.y - share * line.y;
  return dx * dx + dy * dy;
}

}  // namespace

ObstacleMemory::Passage ObstacleMemory::passage(int cell) {
  std::uint8_t& judged = judged_[static_cast<std::size_t>(cell)];
  if (judged == kUnknown) {
    judged = judge(cell);
  }
  return static_cast<Passage>(judged >> 4 & 3);
}

Point2 ObstacleMemory::bestPlace(int cell) {
  passage(cell);
  return centerOf(cell, judged_[static_cast<std::size_t>(cell)] & 0xf);
}

std::uint8_t ObstacleMemory::exits(int cell) {
  passage(cell);
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
  for (int i = 0; i <= parts; ++i) {
    const double share = static_cast<double>(i) / parts;
    const Point2 at{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    const int cell = cellAt(at);
    if (cell < 0) {
      return false;
    }
    passage(cell);
    if ((judged_[static_cast<std::size_t>(cell)] & kNothingNear) == 0 && gap(at) < radius) {
      return false;
    }
  }
  return true;
}

std::uint8_t ObstacleMemory::judge(int cell) const {
  collectNearby(cell, near_cells_);
  int best_square = kSide / 2 * kSide + kSide / 2;
  if (nearby_.empty()) {
    return static_cast<std::uint8_t>(kNothingNear | static_cast<int>(Passage::kRoomy) << 4 | best_square);
  }
  double best = -1.0;
  for (int square = 0; square < kCellSquares; ++square) {
    const Point2 center = centerOf(cell, square);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point2& obstacle : nearby_) {
      const double dx = obstacle.x - center.x;
      const double dy = obstacle.y - center.y;
      nearest = std::min(nearest, dx * dx + dy * dy);
    }
    if (nearest > best) {
      best = nearest;
      best_square = square;
    }
  }
  const Passage passage = best < tight_radius_ * tight_radius_     ? Passage::kBlocked
                          : best < narrow_radius_ * narrow_radius_ ? Passage::kTight
                          : best < roomy_radius_ * roomy_radius_   ? Passage::kNarrow
                                                                   : Passage::kRoomy;
  return static_cast<std::uint8_t>(static_cast<int>(passage) << 4 | best_square);
}

std::uint8_t ObstacleMemory::judgeExits(int cell) {
  const int column = cell % side_;
  const int row = cell / side_;
  if (column == 0 || row == 0 || column == side_ - 1 || row == side_ - 1 || passage(cell) == Passage::kBlocked) {
    return 0;
  }
  std::array<int, kGridRayCount> neighbours;
  std::array<bool, kGridRayCount> enters;
  for (std::size_t direction = 0; direction < neighbours.size(); ++direction) {
    neighbours[direction] = cell + kGridRaySteps[direction].row * side_ + kGridRaySteps[direction].column;
    enters[direction] = passage(neighbours[direction]) != Passage::kBlocked;
  }
  collectNearby(cell, near_cells_ + 1);
  const double radius = onTheWay(tight_radius_);
  const Point2 from = bestPlace(cell);
  std::uint8_t exits = 0;
  for (std::size_t direction = 0; direction < neighbours.size(); ++direction) {
    if (!enters[direction]) {
      continue;
    }
    const Point2 to = bestPlace(neighbours[direction]);
    const bool free = std::none_of(nearby_.begin(), nearby_.end(), [&](const Point2& obstacle) {
      return squaredDistanceToLine(obstacle, from, to) < radius * radius;
    });
    exits = static_cast<std::uint8_t>(exits | (free ? 1u << direction : 0u));
  }
  return exits;
}

void ObstacleMemory::collectNearby(int cell, int reach) const {
  nearby_.clear();
  const int column = cell % side_;
  const int row = cell / side_;
  for (int r = std::max(0, row - reach); r <= std::min(side_ - 1, row + reach); ++r) {
    for (int c = std::max(0, column - reach); c <= std::min(side_ - 1, column + reach); ++c) {
      const std::uint16_t mask = occupied_[static_cast<std::size_t>(r * side_ + c)];
      for (int bit = 0; mask >> bit != 0; ++bit) {
        if ((mask >> bit & 1) != 0) {
          nearby_.push_back(centerOf(r * side_ + c, bit));
        }
      }
    }
  }
  const Point2 middle = centerOf(cell);
  for (const Point2& block : blocks_) {
    if (distanceBetween(block, middle) < (reach + 1) * cell_size_) {
      nearby_.push_back(block);
    }
  }
}

double ObstacleMemory::gap(const Point2& position) const {
  collectNearby(cellAt(position), near_cells_);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point2& obstacle : nearby_) {
    nearest = std::min(nearest, distanceBetween(position, obstacle));
  }
  return nearest;
}

}  // namespace lstm_planner
