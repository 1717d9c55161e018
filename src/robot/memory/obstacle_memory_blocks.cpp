// What is passable where something was blocked, or where squares are so small that obstacle_memory_passages.cpp does
// not see far enough: the same, obstacle by obstacle.

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/base/grid/grid_rays.hpp"
#include "lstm_planner/robot/memory/obstacle_memory.hpp"

namespace lstm_planner {

namespace {

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

std::uint8_t ObstacleMemory::judgeAmongBlocks(int cell) const {
  collectNearby(cell, near_cells_);
  if (nearby_.empty()) {
    return kNothingNear;
  }
  int best_square = 0;
  double best = -1.0;
  for (int square = 0; square < kCellSquares; ++square) {
    const Point2 center = centerOf(squareOf(cell, square));
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
  return judgementOf(best, best_square);
}

std::uint8_t ObstacleMemory::judgeExitsAmongBlocks(int cell) {
  const auto neighbourOf = [&](const CellIndex& step) { return cell + step.row * side_ + step.column; };
  for (const CellIndex& step : kGridRaySteps) judgement(neighbourOf(step));  // before others are collected than here
  collectNearby(cell, near_cells_ + 1);
  const double radius = onTheWay(tight_radius_);
  const Point2 from = bestPlace(cell);
  std::uint8_t exits = 0;
  for (std::size_t direction = 0; direction < kGridRaySteps.size(); ++direction) {
    const int neighbour = neighbourOf(kGridRaySteps[direction]);
    if (passage(neighbour) == Passage::kBlocked) {
      continue;
    }
    const Point2 to = bestPlace(neighbour);
    const bool free = std::none_of(nearby_.begin(), nearby_.end(), [&](const Point2& obstacle) {
      return squaredDistanceToLine(obstacle, from, to) < radius * radius;
    });
    exits = static_cast<std::uint8_t>(exits | (free ? 1u << direction : 0u));
  }
  return exits;
}

void ObstacleMemory::collectNearby(int cell, int reach) const {
  nearby_.clear();
  const Square first = squareOf(cell, 0);
  const int squares = kSide * reach;
  const int last_row = std::min(squares_.rows(), first.row + squares + kSide);
  const int last_column = std::min(squares_.columns(), first.column + squares + kSide);
  for (int row = std::max(0, first.row - squares); row < last_row; ++row) {
    for (int column = std::max(0, first.column - squares); column < last_column; ++column) {
      if (squares_.test(column, row)) {
        nearby_.push_back(centerOf(Square{column, row}));
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

}  // namespace lstm_planner
