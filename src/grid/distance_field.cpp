#include "lstm_planner/grid/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

namespace lstm_planner {
namespace {

/// Distance where nothing is blocked, m.
constexpr float kNothingBlocked = 1e6f;

/// The exact transform squares distances in cells as int.
constexpr int kLongestSide = 46340;

std::size_t offsetOf(CellIndex index, int columns) {
  return static_cast<std::size_t>(index.row) * static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(index.column);
}

}  // namespace

DistanceField::DistanceField(const OccupancyGrid& grid, bool unknown_blocks)
    : columns_(grid.columns()), rows_(grid.rows()) {
  if (columns_ == 0 || rows_ == 0) return;
  if (columns_ > kLongestSide || rows_ > kLongestSide) {
    throw std::invalid_argument("the grid has " + std::to_string(columns_) + " x " + std::to_string(rows_) +
                                " cells, expected at most 46340 a side for a distance field");
  }
  bool any_blocked = false;
  cv::Mat passable(rows_, columns_, CV_8U);
  for (int row = 0; row < rows_; ++row) {
    std::uint8_t* line = passable.ptr<std::uint8_t>(row);
    for (int column = 0; column < columns_; ++column) {
      const Cell cell = grid.at({column, row});
      const bool blocked = cell == Cell::kOccupied || (unknown_blocks && cell == Cell::kUnknown);
      line[column] = blocked ? 0 : 255;
      any_blocked = any_blocked || blocked;
    }
  }

  distances_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_), kNothingBlocked);
  if (!any_blocked) return;
  cv::Mat distances(rows_, columns_, CV_32F, distances_.data());
  cv::distanceTransform(passable, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const float resolution = static_cast<float>(grid.resolution());
  for (float& distance : distances_) distance *= resolution;
}

float DistanceField::at(CellIndex index) const {
  const bool inside = index.column >= 0 && index.row >= 0 && index.column < columns_ && index.row < rows_;
  return inside ? distances_[offsetOf(index, columns_)] : 0.0f;
}

GeodesicField::GeodesicField(const OccupancyGrid& grid, const DistanceField& distances, CellIndex goal,
                             const Options& options)
    : columns_(grid.columns()), rows_(grid.rows()) {
  constexpr float kUnreachable = std::numeric_limits<float>::infinity();
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  lengths_.assign(cells, kUnreachable);

  // What a metre costs in each cell, 0 where the robot does not fit.
  std::vector<float> cost(cells, 0.0f);
  const double margin = options.comfort - options.clearance;
  for (const CellIndex cell : grid.cells()) {
    const float distance = distances.at(cell);
    if (distance <= 0.0f || distance < options.clearance) continue;
    const double nearness = margin > 0.0 ? std::max(0.0, (options.comfort - distance) / margin) : 0.0;
    cost[offsetOf(cell, columns_)] = static_cast<float>(1.0 + options.reluctance * nearness);
  }
  const auto costAt = [&](int column, int row) {
    return grid.contains({column, row}) ? cost[offsetOf({column, row}, columns_)] : 0.0f;
  };
  if (!(costAt(goal.column, goal.row) > 0.0f)) return;

  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
  const std::size_t start = offsetOf(goal, columns_);
  lengths_[start] = 0.0f;
  open.push({0.0f, start});
  const float straight = static_cast<float>(grid.resolution());
  const float diagonal = static_cast<float>(grid.resolution() * M_SQRT2);
  while (!open.empty()) {
    const auto [length, here] = open.top();
    open.pop();
    if (length > lengths_[here]) continue;
    const int column = static_cast<int>(here % static_cast<std::size_t>(columns_));
    const int row = static_cast<int>(here / static_cast<std::size_t>(columns_));
    for (int up = -1; up <= 1; ++up) {
      for (int right = -1; right <= 1; ++right) {
        const float neighbour_cost = costAt(column + right, row + up);
        if ((right == 0 && up == 0) || neighbour_cost <= 0.0f) continue;
        const bool is_diagonal = right != 0 && up != 0;
        if (is_diagonal && (costAt(column + right, row) <= 0.0f || costAt(column, row + up) <= 0.0f)) continue;
        const float step = (is_diagonal ? diagonal : straight) * 0.5f * (cost[here] + neighbour_cost);
        const std::size_t neighbour = offsetOf({column + right, row + up}, columns_);
        if (length + step >= lengths_[neighbour]) continue;
        lengths_[neighbour] = length + step;
        open.push({length + step, neighbour});
      }
    }
  }
}

float GeodesicField::at(CellIndex index) const {
  const bool inside = index.column >= 0 && index.row >= 0 && index.column < columns_ && index.row < rows_;
  return inside ? lengths_[offsetOf(index, columns_)] : std::numeric_limits<float>::infinity();
}

CellIndex GeodesicField::nextOnPath(CellIndex cell) const {
  CellIndex next = cell;
  for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
    for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
      if (at({column, row}) < at(next)) next = {column, row};
    }
  }
  return next;
}

}  // namespace lstm_planner
