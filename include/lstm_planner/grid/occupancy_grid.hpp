#pragma once

#include <cstdint>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/grid/cell_field.hpp"

namespace lstm_planner {

/// State of a cell of a map_server map.
enum class Cell : std::uint8_t { kFree, kOccupied, kUnknown };

/// A grid with a metric scale. Row 0 is the lowest, column 0 the leftmost. `origin` is the pose of the lower left
/// corner of cell (0, 0) in the map frame, with any yaw. Cells outside are kUnknown.
class OccupancyGrid : public CellField<Cell> {
 public:
  OccupancyGrid() = default;
  /// All cells are `fill`. `resolution` is in m per cell. Throws std::invalid_argument for a size or resolution that is
  /// not positive, an origin that is not finite, or more than 2^28 cells.
  OccupancyGrid(int columns, int rows, double resolution, Pose2 origin = {}, Cell fill = Cell::kFree);

  double resolution() const { return resolution_; }
  const Pose2& origin() const { return origin_; }

  Cell at(CellIndex index) const { return CellField::at(index, Cell::kUnknown); }
  /// `index` must be inside.
  void set(CellIndex index, Cell cell) { (*this)[index] = cell; }

  /// The cell that contains the point (map frame, m); it may be outside.
  CellIndex cellAt(const Point2& point) const;
  /// Centre of a cell in the map frame, m.
  Point2 centerOf(CellIndex index) const;

 private:
  double resolution_ = 1.0;
  Pose2 origin_;
};

}  // namespace lstm_planner
