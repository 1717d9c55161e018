#include "lstm_planner/drive/perception/costmap_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace lstm_planner {

namespace {

// As in costmap_2d/cost_values.h.
constexpr unsigned char kInscribed = 253;
constexpr unsigned char kLethal = 254;

constexpr double kPointSpacing = 0.06;  // m between the points of a large cell, at most
constexpr double kNear = 0.5;           // m within which obstacles count wherever they are

/// Of some cells whether each is meant, row by row.
struct CellMask {
  CellMask(int mask_columns, int mask_rows)
      : columns(mask_columns),
        rows(mask_rows),
        cells(static_cast<std::size_t>(mask_columns) * static_cast<std::size_t>(mask_rows)) {}

  std::uint8_t* row(int number) { return cells.data() + static_cast<std::ptrdiff_t>(number) * columns; }
  const std::uint8_t* row(int number) const { return cells.data() + static_cast<std::ptrdiff_t>(number) * columns; }

  int columns;
  int rows;
  std::vector<std::uint8_t> cells;
};

/// What is within so many columns and rows of a cell. Twice as far each time: `around` may be many cells.
CellMask dilated(CellMask mask, int around) {
  for (int done = 0; done < around;) {
    const int by = std::min(around - done, done + 1);  // more would leave gaps, or lose what crosses the border
    CellMask wide = mask;
    for (int row = 0; row < mask.rows; ++row) {
      const std::uint8_t* const from = mask.row(row);
      std::uint8_t* const to = wide.row(row);
      for (int column = by; column < mask.columns; ++column) to[column] |= from[column - by];
      for (int column = by; column < mask.columns; ++column) to[column - by] |= from[column];
    }
    mask = wide;
    for (int row = by; row < mask.rows; ++row) {
      for (int column = 0; column < mask.columns; ++column) {
        mask.row(row)[column] |= wide.row(row - by)[column];
        mask.row(row - by)[column] |= wide.row(row)[column];
      }
    }
    done += by;
  }
  return mask;
}

/// The part of a costmap that is looked at.
class CostWindow {
 public:
  /// All within `far` (m) of the robot.
  CostWindow(const CostGrid& grid, const Pose2& base, double far) : grid_(grid), base_(base) {
    const auto index = [&](double position, double origin, int count) {
      return static_cast<int>(
          std::clamp(std::floor((position - origin) / grid.resolution), 0.0, static_cast<double>(count)));
    };
    first_column_ = index(base.x - far, grid.origin.x, grid.columns);
    first_row_ = index(base.y - far, grid.origin.y, grid.rows);
    columns_ = index(base.x + far + grid.resolution, grid.origin.x, grid.columns) - first_column_;
    rows_ = index(base.y + far + grid.resolution, grid.origin.y, grid.rows) - first_row_;
  }

  /// The cells of that cost.
  CellMask cellsOf(unsigned char cost) const {
    CellMask mask(columns_, rows_);
    for (int row = 0; row < rows_; ++row) {
      const unsigned char* const costs =
          grid_.costs + static_cast<std::ptrdiff_t>(first_row_ + row) * grid_.columns + first_column_;
      std::transform(costs, costs + columns_, mask.row(row),
                     [cost](unsigned char there) { return static_cast<std::uint8_t>(there == cost); });
    }
    return mask;
  }

  CellMask cellsWith(const std::vector<Point2>& returns) const {
    CellMask mask(columns_, rows_);
    const double scale = 1.0 / grid_.resolution;
    const double c = std::cos(base_.yaw) * scale;
    const double s = std::sin(base_.yaw) * scale;
    const double x = (base_.x - grid_.origin.x) * scale - first_column_;
    const double y = (base_.y - grid_.origin.y) * scale - first_row_;
    for (const Point2& place : returns) {
      const double column = x + c * place.x - s * place.y;
      const double row = y + s * place.x + c * place.y;
      if (!(column >= 0.0 && row >= 0.0 && column < columns_ && row < rows_)) continue;
      mask.row(static_cast<int>(row))[static_cast<int>(column)] = 1;
    }
    return mask;
  }

  /// The occupied cells that are not shown, as points.
  std::vector<Point2> pointsOf(const CellMask& occupied, const CellMask& shown, double reach) const {
    std::vector<Point2> points;
    const int parts = static_cast<int>(std::ceil(grid_.resolution / kPointSpacing));
    const double part = grid_.resolution / parts;
    const double half = 0.5 * grid_.resolution;
    const double c = std::cos(base_.yaw);
    const double s = std::sin(base_.yaw);
    for (int row = 0; row < rows_; ++row) {
      const double bottom = grid_.origin.y + (first_row_ + row) * grid_.resolution - base_.y;
      for (int column = 0; column < columns_; ++column) {
        if (occupied.row(row)[column] == 0 || shown.row(row)[column] != 0) continue;
        const double left = grid_.origin.x + (first_column_ + column) * grid_.resolution - base_.x;
        const double squared = (left + half) * (left + half) + (bottom + half) * (bottom + half);
        if (squared > reach * reach || (squared > kNear * kNear && isSurrounded(occupied, column, row))) continue;
        for (int k = 0; k < parts * parts; ++k) {
          const double x = left + (k % parts + 0.5) * part;
          const double y = bottom + (k / parts + 0.5) * part;
          points.push_back({c * x + s * y, c * y - s * x});
        }
      }
    }
    return points;
  }

 private:
  /// Whether there are obstacles on all four sides.
  bool isSurrounded(const CellMask& occupied, int column, int row) const {
    if (column == 0 || row == 0 || column + 1 == columns_ || row + 1 == rows_) return false;
    const std::uint8_t* const here = occupied.row(row) + column;
    return here[-1] != 0 && here[1] != 0 && here[-columns_] != 0 && here[columns_] != 0;
  }

  const CostGrid& grid_;
  const Pose2& base_;
  int first_column_;
  int first_row_;
  int columns_;
  int rows_;
};

}  // namespace

std::vector<Point2> costmapObstacles(const CostGrid& grid, const Pose2& base, const std::vector<Point2>& returns,
                                     double reach) {
  if (grid.costs == nullptr || !(grid.resolution > 0.0) || !isFinite(base)) return {};
  // What is inscribed may have its reason a little farther away.
  const CostWindow window(grid, base, reach + grid.inscribed_radius + 2.0 * grid.resolution);
  CellMask occupied = window.cellsOf(kLethal);
  const CellMask inscribed = window.cellsOf(kInscribed);
  const int around = static_cast<int>(std::ceil(grid.inscribed_radius / grid.resolution)) + 1;
  const CellMask explained = dilated(occupied, around);
  for (std::size_t i = 0; i < occupied.cells.size(); ++i) {
    occupied.cells[i] |= static_cast<std::uint8_t>(inscribed.cells[i] & ~explained.cells[i]);
  }
  return window.pointsOf(occupied, dilated(window.cellsWith(returns), 1), reach);
}

}  // namespace lstm_planner
