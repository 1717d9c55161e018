#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// The walls that an agent has sensed near where it is: one bit a cell of a square window that rolls along with it.
/// What it has not sensed, or what has left the window, counts as free.
class RollingGrid {
 public:
  static constexpr int kSide = 160;  ///< of the window, cells

  RollingGrid();

  void clear();

  /// Keeps the agent in the middle, give or take 16 cells, and marks where the rays end. Whether a wall is new.
  bool observe(const GridObservation& observation);

  /// First column and row of the window.
  CellIndex origin() const { return origin_; }
  bool contains(CellIndex cell) const {
    return cell.column >= origin_.column && cell.row >= origin_.row && cell.column < origin_.column + kSide &&
           cell.row < origin_.row + kSide;
  }
  bool isWall(CellIndex cell) const {
    return contains(cell) && isWallAt(cell.column - origin_.column, cell.row - origin_.row);
  }
  /// The walls beside a cell that is not at the window's edge, counted from its origin: bit d for direction d.
  unsigned wallsBeside(int column, int row) const {
    const unsigned before = threeBits(column - 1, row - 1);
    const unsigned beside = threeBits(column - 1, row);
    const unsigned after = threeBits(column - 1, row + 1);
    return (beside >> 2) | (after >> 2) << 1 | (after & 2u) << 1 | (after & 1u) << 3 | (beside & 1u) << 4 |
           (before & 1u) << 5 | (before & 2u) << 5 | (before >> 2) << 7;
  }

  std::size_t bytes() const { return bytes_.size(); }

 private:
  static constexpr int kByteBits = 8;
  static constexpr int kRollStep = 16;  ///< cells by which the window rolls, whole bytes
  static constexpr int kRowBytes = kSide / kByteBits;

  static std::size_t byteOf(int column, int row) {
    return static_cast<std::size_t>(row * kRowBytes + column / kByteBits);
  }
  bool isWallAt(int column, int row) const { return (bytes_[byteOf(column, row)] >> (column % kByteBits) & 1) != 0; }
  unsigned threeBits(int column, int row) const {
    const std::size_t byte = byteOf(column, row);
    return (bytes_[byte] | static_cast<unsigned>(bytes_[byte + 1]) << kByteBits) >> (column % kByteBits) & 7u;
  }
  void roll(CellIndex origin);

  bool placed_ = false;
  CellIndex origin_;
  std::vector<std::uint8_t> bytes_;  ///< and one more, which threeBits() may read
};

}  // namespace lstm_planner
