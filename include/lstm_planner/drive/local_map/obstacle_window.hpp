#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/grid/bit_rows.hpp"

namespace lstm_planner {

/// A square by its place in the window, or, where that is said, in the odometry frame.
struct Square {
  int column;
  int row;
};

/// A square of the window in one number.
inline std::uint32_t keyOf(const Square& square) {
  return static_cast<std::uint32_t>(square.row) << 16 | static_cast<std::uint32_t>(square.column);
}
inline Square squareOf(std::uint32_t key) { return {static_cast<int>(key & 0xffff), static_cast<int>(key >> 16)}; }

/// Where something stands, in a window that moves along with the robot: one bit a square. Four by four squares are a
/// cell. Positions are in the odometry frame, m.
class ObstacleWindow {
 public:
  static constexpr int kSide = 4;                     ///< squares a side of a cell
  static constexpr int kCellSquares = kSide * kSide;  ///< squares of a cell

  /// `width` of the window and `resolution`, a square's side, in m.
  ObstacleWindow(double width, double resolution);

  /// Nothing stands anywhere, and the window is nowhere.
  void clear();
  /// Moves along when the robot at `pose` has come far from the middle; whether it did.
  bool moveTo(const Pose2& pose);

  int side() const { return side_; }  ///< cells a side
  double cellSize() const { return cell_size_; }
  double resolution() const { return resolution_; }
  /// The first square, by its place in the odometry frame.
  Square origin() const { return {kSide * origin_column_, kSide * origin_row_}; }

  /// Index of the cell at a position, row by row; -1 outside the window.
  int cellAt(const Point2& position) const;
  Point2 centerOf(int cell) const;
  bool isAtBorder(int cell) const {
    const int column = cell % side_;
    return column == 0 || column == side_ - 1 || cell < side_ || cell >= side_ * (side_ - 1);
  }
  /// The square at a position, which may lie outside the window.
  Square squareAt(const Point2& position) const;
  Square squareOf(int cell, int square) const {
    return {cell % side_ * kSide + square % kSide, cell / side_ * kSide + square / kSide};
  }
  Point2 centerOf(const Square& square) const {
    return {(origin_column_ * kSide + square.column + 0.5) * resolution_,
            (origin_row_ * kSide + square.row + 0.5) * resolution_};
  }

  /// The middles of all squares where something stands.
  std::vector<Point2> occupied() const;
  /// Calls visit(square) for the occupied squares of a rectangle, both corners included, as far as it lies in the
  /// window, until it answers true.
  template <typename Visit>
  void visitOccupied(const Square& first, const Square& last, const Visit& visit) const;
  /// Visits the middles of the occupied squares that are at most `reach` (m) from a place along each axis.
  template <typename Visit>
  void visitOccupiedNear(const Point2& place, double reach, const Visit& visit) const;
  bool contains(const Square& square) const {
    return square.column >= 0 && square.column < squares_.columns() && square.row >= 0 && square.row < squares_.rows();
  }
  bool isOccupied(const Square& square) const { return squares_.test(square.column, square.row); }
  /// Whether something stands there from now on; the square's cell.
  int set(const Square& square, bool occupied);
  const BitRows& cells() const { return cells_; }  ///< with an occupied square

 private:
  double resolution_;
  int side_;
  double cell_size_;
  int origin_column_ = 0;  ///< cells, in the odometry frame
  int origin_row_ = 0;
  bool placed_ = false;
  BitRows squares_;
  BitRows cells_;
};

template <typename Visit>
void ObstacleWindow::visitOccupied(const Square& first, const Square& last, const Visit& visit) const {
  constexpr int kWord = 64;
  const int left = std::max(0, first.column);
  const int right = std::min(squares_.columns(), last.column + 1);
  for (int row = std::max(0, first.row); row <= std::min(squares_.rows() - 1, last.row); ++row) {
    for (int column = left; column < right; column += kWord) {
      std::uint64_t bits = squares_.from(column, row) & lowestBits(std::min(kWord, right - column));
      for (; bits != 0; bits &= bits - 1) {
        if (visit(Square{column + lowestBit(bits), row})) return;
      }
    }
  }
}

template <typename Visit>
void ObstacleWindow::visitOccupiedNear(const Point2& place, double reach, const Visit& visit) const {
  const Square middle = squareAt(place);
  const int around = static_cast<int>(std::ceil(reach / resolution_));
  visitOccupied({middle.column - around, middle.row - around}, {middle.column + around, middle.row + around},
                [&](const Square& square) {
                  visit(centerOf(square));
                  return false;
                });
}

}  // namespace lstm_planner
