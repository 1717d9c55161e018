#pragma once

#include <bitset>
#include <cstddef>

#include "lstm_planner/grid_world/agent/grid_block.hpp"

namespace lstm_planner {

/// Some of the cells of 4 x 4 blocks that lie beside each other.
class BlockPatch {
 public:
  /// `cells`: of a block, bit 4 row + column. `block`: from the first block of the patch.
  void add(unsigned cells, CellIndex block) {
    constexpr unsigned kRow = 0xf;
    for (int row = 0; row < kBlockSide; ++row) {
      const int first = (block.row * kBlockSide + row) * static_cast<int>(kSide) + block.column * kBlockSide;
      cells_ |= Cells(cells >> (row * kBlockSide) & kRow) << static_cast<std::size_t>(first);
    }
  }

  /// Whether straight moves inside `open` lead from one of these cells to one of `to`.
  bool leadsTo(const BlockPatch& to, const BlockPatch& open) const {
    Cells reached = cells_ & open.cells_;
    while ((reached & to.cells_).none()) {
      const Cells beside =
          (reached << 1 & notColumn(0)) | (reached >> 1 & notColumn(kSide - 1)) | reached << kSide | reached >> kSide;
      const Cells wider = (reached | beside) & open.cells_;
      if (wider == reached) return false;
      reached = wider;
    }
    return true;
  }

 private:
  static constexpr std::size_t kSide = 4 * kBlockSide;
  using Cells = std::bitset<kSide * kSide>;

  static Cells notColumn(std::size_t column) {
    static const Cells first_column = [] {
      Cells cells;
      for (std::size_t row = 0; row < kSide; ++row) cells.set(row * kSide);
      return cells;
    }();
    return ~(first_column << column);
  }

  Cells cells_;
};

}  // namespace lstm_planner
