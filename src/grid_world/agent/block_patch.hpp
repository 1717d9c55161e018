#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lstm_planner/grid_world/agent/seen_grid.hpp"

namespace lstm_planner {

/// Some of the cells of 4 x 4 blocks that lie beside each other.
class BlockPatch {
 public:
  /// `cells`: of a block, bit 4 row + column. `block`: from the first block of the patch.
  void add(unsigned cells, CellIndex block) {
    constexpr unsigned kRow = 0xf;
    for (int row = 0; row < kBlockSide; ++row) {
      const unsigned bits = (cells >> (row * kBlockSide) & kRow) << (block.column * kBlockSide);
      std::uint16_t& whole = rows_[static_cast<std::size_t>(block.row * kBlockSide + row)];
      whole = static_cast<std::uint16_t>(whole | bits);
    }
  }

  /// Whether straight moves inside `open` lead from one of these cells to one of `to`.
  bool leadsTo(const BlockPatch& to, const BlockPatch& open) const {
    // Beyond the first and the last row nothing is open.
    std::array<unsigned, kSide + 2> reached{};
    for (std::size_t row = 0; row < kSide; ++row) reached[row + 1] = rows_[row] & open.rows_[row];
    for (bool wider = true; wider;) {
      unsigned grown = 0;
      unsigned arrived = 0;
      for (std::size_t row = 0; row < kSide; ++row) {
        unsigned& here = reached[row + 1];
        const unsigned next = (here | here << 1 | here >> 1 | reached[row] | reached[row + 2]) & open.rows_[row];
        grown |= next ^ here;
        here = next;
        arrived |= here & to.rows_[row];
      }
      if (arrived != 0) return true;
      wider = grown != 0;
    }
    return false;
  }

 private:
  static constexpr std::size_t kSide = 4 * kBlockSide;

  std::array<std::uint16_t, kSide> rows_{};  ///< bit by column
};

}  // namespace lstm_planner
