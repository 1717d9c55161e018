#include "lstm_planner/grid/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace lstm_planner {
namespace {

/// Distance where nothing is blocked, m.
constexpr float kNothingBlocked = 1e6f;

/// The exact transform squares distances in cells as int.
constexpr int kLongestSide = 46340;

/// Cells; from here on a float may not become longer by a move.
constexpr float kTooLong = 16777216.0f;  // 2^24

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

/// By buckets as wide as the shortest move (Dial's algorithm): a move leads to a later bucket but for rounding, and
/// what it leads to in the same bucket is still gone through there.
template <typename Cost>
CellField<float> pathLengths(const CellField<Cost>& cost, CellIndex goal, CornerCutting corner_cutting,
                             double resolution) {
  CellField<float> lengths(cost.columns(), cost.rows(), std::numeric_limits<float>::infinity());
  const auto costAt = [&](CellIndex cell) { return static_cast<float>(cost.at(cell, Cost{})); };
  if (!(costAt(goal) > 0.0f)) return lengths;
  struct Open {
    CellIndex cell;
    float length;
  };
  const float moves[] = {static_cast<float>(resolution), static_cast<float>(resolution * M_SQRT2)};
  const float width = moves[0];
  std::deque<std::vector<Open>> buckets(1);
  lengths[goal] = 0.0f;
  buckets.front().push_back({goal, 0.0f});
  for (std::size_t first = 0; !buckets.empty(); ++first, buckets.pop_front()) {
    const std::vector<Open>& bucket = buckets.front();
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const auto [here, length_here] = bucket[i];
      if (length_here > lengths[here]) continue;
      const float cost_here = costAt(here);
      for (int direction = 0; direction < kGridMoveCount; ++direction) {
        const CellIndex cell = cellBeside(here, direction);
        const float cost_there = costAt(cell);
        if (!(cost_there > 0.0f)) continue;
        const bool is_diagonal = direction % 2 != 0;
        if (is_diagonal && corner_cutting == CornerCutting::kForbidden &&
            !(costAt(cellBeside(here, turned(direction, -1))) > 0.0f &&
              costAt(cellBeside(here, turned(direction, 1))) > 0.0f)) {
          continue;
        }
        const float length = length_here + moves[is_diagonal] * 0.5f * (cost_here + cost_there);
        if (length >= lengths[cell] || length >= kTooLong * width) continue;
        lengths[cell] = length;
        const std::size_t index = static_cast<std::size_t>(length / width) - first;
        if (index >= buckets.size()) buckets.resize(index + 1);
        buckets[index].push_back({cell, length});
      }
    }
  }
  return lengths;
}

template CellField<float> pathLengths(const CellField<float>&, CellIndex, CornerCutting, double);
template CellField<float> pathLengths(const CellField<std::uint8_t>&, CellIndex, CornerCutting, double);

GeodesicField::GeodesicField(const OccupancyGrid& grid, const DistanceField& distances, CellIndex goal,
                             const Options& options) {
  // What a metre costs in each cell, 0 where the robot does not fit.
  CellField<float> cost(grid.columns(), grid.rows(), 0.0f);
  const double margin = options.comfort - options.clearance;
  for (const CellIndex cell : grid.cells()) {
    const float distance = distances.at(cell);
    if (distance <= 0.0f || distance < options.clearance) continue;
    const double nearness = margin > 0.0 ? std::max(0.0, (options.comfort - distance) / margin) : 0.0;
    cost[cell] = static_cast<float>(1.0 + options.reluctance * nearness);
  }
  lengths_ = pathLengths(cost, goal, CornerCutting::kForbidden, grid.resolution());
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
