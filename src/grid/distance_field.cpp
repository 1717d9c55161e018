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

}  // namespace

DistanceField::DistanceField(const OccupancyGrid& grid, bool unknown_blocks) {
  const int columns = grid.columns();
  const int rows = grid.rows();
  if (columns == 0 || rows == 0) return;
  if (columns > kLongestSide || rows > kLongestSide) {
    throw std::invalid_argument("the grid has " + std::to_string(columns) + " x " + std::to_string(rows) +
                                " cells, expected at most 46340 a side for a distance field");
  }
  bool any_blocked = false;
  cv::Mat passable(rows, columns, CV_8U);
  for (int row = 0; row < rows; ++row) {
    std::uint8_t* line = passable.ptr<std::uint8_t>(row);
    for (int column = 0; column < columns; ++column) {
      const Cell cell = grid.at({column, row});
      const bool blocked = cell == Cell::kOccupied || (unknown_blocks && cell == Cell::kUnknown);
      line[column] = blocked ? 0 : 255;
      any_blocked = any_blocked || blocked;
    }
  }

  distances_ = {columns, rows, kNothingBlocked};
  if (!any_blocked) return;
  cv::Mat distances(rows, columns, CV_32F, distances_.values().data());
  cv::distanceTransform(passable, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const float resolution = static_cast<float>(grid.resolution());
  for (float& distance : distances_.values()) distance *= resolution;
}

GeodesicField::GeodesicField(const OccupancyGrid& grid, const DistanceField& distances, CellIndex goal,
                             const Options& options)
    : lengths_(grid.columns(), grid.rows(), std::numeric_limits<float>::infinity()) {
  // What a metre costs in each cell, 0 where the robot does not fit.
  CellField<float> cost(grid.columns(), grid.rows(), 0.0f);
  const double margin = options.comfort - options.clearance;
  for (const CellIndex cell : grid.cells()) {
    const float distance = distances.at(cell);
    if (distance <= 0.0f || distance < options.clearance) continue;
    const double nearness = margin > 0.0 ? std::max(0.0, (options.comfort - distance) / margin) : 0.0;
    cost[cell] = static_cast<float>(1.0 + options.reluctance * nearness);
  }
  const auto costAt = [&](int column, int row) { return cost.at({column, row}, 0.0f); };
  if (!(cost.at(goal, 0.0f) > 0.0f)) return;

  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
  lengths_[goal] = 0.0f;
  open.push({0.0f, lengths_.offset(goal)});
  const float straight = static_cast<float>(grid.resolution());
  const float diagonal = static_cast<float>(grid.resolution() * M_SQRT2);
  while (!open.empty()) {
    const auto [length, offset] = open.top();
    const CellIndex here = lengths_.cellAt(offset);
    const auto [column, row] = here;
    open.pop();
    if (length > lengths_[here]) continue;
    for (int up = -1; up <= 1; ++up) {
      for (int right = -1; right <= 1; ++right) {
        const float neighbour_cost = costAt(column + right, row + up);
        if ((right == 0 && up == 0) || neighbour_cost <= 0.0f) continue;
        const bool is_diagonal = right != 0 && up != 0;
        if (is_diagonal && (costAt(column + right, row) <= 0.0f || costAt(column, row + up) <= 0.0f)) continue;
        const float step = (is_diagonal ? diagonal : straight) * 0.5f * (cost[here] + neighbour_cost);
        const CellIndex neighbour{column + right, row + up};
        if (length + step >= lengths_[neighbour]) continue;
        lengths_[neighbour] = length + step;
        open.push({length + step, lengths_.offset(neighbour)});
      }
    }
  }
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
