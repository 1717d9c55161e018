#pragma once

#include <cstddef>
#include <vector>

namespace lstm_planner {

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

/// A value for each cell of a grid.
template <typename Value>
class CellField {
 public:
  CellField() = default;
  CellField(int columns, int rows, const Value& fill)
      : columns_(columns),
        rows_(rows),
        values_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), fill) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  CellRange cells() const { return {columns_, rows_}; }
  bool contains(CellIndex cell) const {
    return cell.column >= 0 && cell.row >= 0 && cell.column < columns_ && cell.row < rows_;
  }

  /// `cell` must be inside.
  Value& operator[](CellIndex cell) { return values_[offset(cell)]; }
  const Value& operator[](CellIndex cell) const { return values_[offset(cell)]; }
  Value at(CellIndex cell, Value outside) const { return contains(cell) ? values_[offset(cell)] : outside; }

  /// The values lie row by row. A cell inside has this number among them, and size() is their number.
  std::size_t offset(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.column);
  }
  CellIndex cellAt(std::size_t offset) const {
    const auto columns = static_cast<std::size_t>(columns_);
    return {static_cast<int>(offset % columns), static_cast<int>(offset / columns)};
  }
  std::size_t size() const { return values_.size(); }
  std::vector<Value>& values() { return values_; }

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Value> values_;
};

}  // namespace lstm_planner
