#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// State of a cell of a map_server map.
enum class Cell : std::uint8_t { kFree, kOccupied, kUnknown };

/// Place of a cell in a grid.
struct CellIndex {
  int column = 0;
  int row = 0;
};
inline bool operator==(CellIndex a, CellIndex b) { return a.column == b.column && a.row == b.row; }
inline bool operator!=(CellIndex a, CellIndex b) { return !(a == b); }

/// All cells of a grid, row by row, for loops: `for (const CellIndex cell : grid.cells())`.
class CellRange {
 public:
  class Iterator {
   public:
    Iterator(int columns, CellIndex cell) : columns_(columns), cell_(cell) {}
    CellIndex operator*() const { return cell_; }
    Iterator& operator++() {
      if (++cell_.column == columns_) cell_ = {0, cell_.row + 1};
      return *this;
    }
    bool operator!=(const Iterator& other) const { return cell_ != other.cell_; }

   private:
    int columns_;
    CellIndex cell_;
  };

  CellRange(int columns, int rows) : columns_(columns), rows_(rows) {}
  Iterator begin() const { return {columns_, {0, 0}}; }
  Iterator end() const { return {columns_, {0, rows_}}; }

 private:
  int columns_;
  int rows_;
};

/// A grid with a metric scale. Row 0 is the lowest, column 0 the leftmost. `origin` is the pose of the lower left
/// corner of cell (0, 0) in the map frame, with any yaw. Cells outside are kUnknown.
class OccupancyGrid {
 public:
  OccupancyGrid() = default;
  /// All cells are `fill`. `resolution` is in m per cell. Throws std::invalid_argument for a size or resolution that is
  /// not positive, an origin that is not finite, or more than 2^28 cells.
  OccupancyGrid(int columns, int rows, double resolution, Pose2 origin = {}, Cell fill = Cell::kFree);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double resolution() const { return resolution_; }
  const Pose2& origin() const { return origin_; }
  CellRange cells() const { return {columns_, rows_}; }

  bool contains(CellIndex index) const {
    return index.column >= 0 && index.row >= 0 && index.column < columns_ && index.row < rows_;
  }
  Cell at(CellIndex index) const { return contains(index) ? cells_[offset(index)] : Cell::kUnknown; }
  /// `index` must be inside.
  void set(CellIndex index, Cell cell) { cells_[offset(index)] = cell; }

  /// The cell that contains the point (map frame, m); it may be outside.
  CellIndex cellAt(const Point2& point) const;
  /// Centre of a cell in the map frame, m.
  Point2 centerOf(CellIndex index) const;

 private:
  std::size_t offset(CellIndex index) const {
    return static_cast<std::size_t>(index.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(index.column);
  }
  int columns_ = 0;
  int rows_ = 0;
  double resolution_ = 1.0;
  Pose2 origin_;
  std::vector<Cell> cells_;
};

}  // namespace lstm_planner
