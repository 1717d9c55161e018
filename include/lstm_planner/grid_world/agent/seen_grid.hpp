#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/agent/rolling_window.hpp"

namespace lstm_planner {

/// Cells along the side of a block, the unit in which an agent remembers a whole area.
constexpr int kBlockSide = 4;

constexpr int blockAlong(int cell) { return cell >> 2; }
static_assert(kBlockSide == 1 << 2 && blockAlong(-1) == -1 && blockAlong(-5) == -2, "rounded down");
/// The block that a cell lies in.
constexpr CellIndex blockOf(CellIndex cell) { return {blockAlong(cell.column), blockAlong(cell.row)}; }
/// Lowest column and row.
constexpr CellIndex firstCellOf(CellIndex block) { return {block.column * kBlockSide, block.row * kBlockSide}; }

/// What an agent has seen of the cells near it: two bits a cell, in a square window that moves with it.
class SeenGrid {
 public:
  /// What is known of a cell.
  enum class Cell {
    kUnknown,   ///< never seen
    kFree,      ///< a ray went through it, or the agent stood there
    kDoubtful,  ///< never seen, but in a gap of at most kWidestGap cells between two walls of a row or column
    kWall       ///< seen to be blocked
  };

  /// The cells of a block, by what is known of them.
  struct BlockCells {
    unsigned free;
    unsigned doubtful;
    unsigned wall;
  };

  static constexpr int kSide = 160;     ///< of the window, cells
  static constexpr int kWidestGap = 6;  ///< cells
  static constexpr int kMargin = 64;    ///< cells between the agent and the window's edges; no ray reaches that far

  /// Forgets everything.
  void restart(CellIndex agent);

  /// Marks what the rays show.
  void observe(const GridObservation& observation);

  /// The blocks in which the latest observation has changed something; a block may occur twice.
  const std::vector<CellIndex>& changedBlocks() const { return changed_blocks_; }

  CellIndex origin() const { return cells_.origin(); }
  bool contains(CellIndex cell) const { return cells_.contains(cell); }
  /// kUnknown outside.
  Cell at(CellIndex cell) const { return static_cast<Cell>(cells_.at(cell)); }
  /// The neighbours of a cell that are walls or, unless `through_doubtful`, doubtful: bit d for direction d.
  unsigned wallsBeside(CellIndex cell, bool through_doubtful) const {
    const std::array<unsigned, 9> around = cells_.around(cell);
    constexpr std::array<std::size_t, kGridRayCount> kPlaces = {5, 8, 7, 6, 3, 0, 1, 2};
    static_assert(Cell::kUnknown < Cell::kDoubtful && Cell::kFree < Cell::kDoubtful && Cell::kDoubtful < Cell::kWall);
    const unsigned least = static_cast<unsigned>(through_doubtful ? Cell::kWall : Cell::kDoubtful);
    unsigned walls = 0;
    for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
      walls |= (around[kPlaces[direction]] >= least ? 1u : 0u) << direction;
    }
    return walls;
  }
  /// The cells of a block that are free, doubtful, and walls: bit 4 * row + column, counted from its first cell.
  BlockCells cellsOf(CellIndex block) const {
    static_assert(kBlockSide == 4, "a byte a row");
    const std::uint32_t cells = cells_.fourBytesFrom(firstCellOf(block));
    constexpr std::uint32_t kLowBits = 0x55555555;
    const std::uint32_t low = cells & kLowBits;
    const std::uint32_t high = cells >> 1 & kLowBits;
    return {everySecondBit(low & ~high), everySecondBit(high & ~low), everySecondBit(high & low)};
  }

  std::size_t bytes() const { return cells_.bytes() + changed_blocks_.capacity() * sizeof(CellIndex); }

 private:
  static constexpr std::size_t kMostChanges = 192;  ///< 13 blocks a ray, and those with gaps at its end

  static unsigned everySecondBit(std::uint32_t bits) {
    bits = (bits | bits >> 1) & 0x33333333;
    bits = (bits | bits >> 2) & 0x0f0f0f0f;
    bits = (bits | bits >> 4) & 0x00ff00ff;
    return (bits | bits >> 8) & 0xffff;
  }
  void set(CellIndex cell, Cell value);
  void markWall(CellIndex cell);
  bool isInGap(CellIndex cell) const;
  int wallWithin(CellIndex cell, std::size_t direction) const;

  RollingWindow<kSide, 2> cells_;
  std::vector<CellIndex> changed_blocks_;
};

}  // namespace lstm_planner
