#include "lstm_planner/drive/local_map/line_masks.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {

namespace {

/// Of a point from the line from the origin to (columns, rows).
double squaredDistance(double x, double y, int columns, int rows) {
  const double length = static_cast<double>(columns) * columns + static_cast<double>(rows) * rows;
  const double share = length > 0.0 ? std::clamp((x * columns + y * rows) / length, 0.0, 1.0) : 0.0;
  const double dx = x - share * columns;
  const double dy = y - share * rows;
  return dx * dx + dy * dy;
}

}  // namespace

void LineMasks::setRadius(double radius) {
  margin_ = static_cast<int>(std::floor(radius));
  const int mask_rows = longest_ + 1 + 2 * margin_;
  masks_.assign(static_cast<std::size_t>((longest_ + 1) * (2 * longest_ + 1) * mask_rows), 0);
  std::size_t next = 0;
  for (int rows = 0; rows <= longest_; ++rows) {
    for (int columns = -longest_; columns <= longest_; ++columns, next += static_cast<std::size_t>(mask_rows)) {
      const int left = std::min(columns, 0) - margin_;
      const int right = std::max(columns, 0) + margin_;
      for (int row = -margin_; row <= rows + margin_; ++row) {
        for (int column = left; column <= right; ++column) {
          if (squaredDistance(column, row, columns, rows) < radius * radius) {
            masks_[next + static_cast<std::size_t>(row + margin_)] |= std::uint64_t{1} << (column - left);
          }
        }
      }
    }
  }
}

}  // namespace lstm_planner
