#pragma once

#include <array>
#include <cstddef>

#include "lstm_planner/grid_world/agent/rolling_window.hpp"
#include "lstm_planner/grid_world/agent/seen_grid.hpp"

namespace lstm_planner {

/// What is remembered of a whole area: not its cells, but whether there is a passage from each block of 4 x 4 cells to
/// the next, two bits for each pair of neighbours. That is an eighth of the memory that two bits a cell would need, and
/// a wall one cell thick still separates its two sides.
///
/// A block stands for its largest connected piece, or for the piece that contains the goal. What walls cut off from
/// that piece belongs to no block. Two pieces that do not touch are connected if cells that were seen free lead from
/// one to the other through the blocks around the two, for example through a door nearby. So corridors of fewer than 7
/// cells may look closed, if they are longer than that.
///
/// When the agent comes back to a block whose cells it has forgotten, what it sees there may close passages. It opens
/// no closed passage, unless the agent stands in it.
class BlockGraph {
 public:
  /// What is known of the passage between two neighbouring blocks.
  enum class Passage {
    kUnknown,   ///< no wall is known between the two
    kFree,      ///< and cells on both sides have been seen free
    kDoubtful,  ///< only through a cell that is doubtful
    kClosed     ///< walls are known to close it
  };

  static constexpr int kSide = 160;   ///< of the window, blocks
  static constexpr int kMargin = 16;  ///< blocks between the agent and the window's edges
  static constexpr unsigned kWholeBlock = 0xffff;

  /// Forgets everything. `seen` must have been restarted at the agent's cell before.
  void restart(const SeenGrid& seen, CellIndex agent);

  /// Learns what has changed in `seen`, and where the agent and the goal are.
  void update(const SeenGrid& seen, CellIndex agent, CellIndex goal);

  /// What there is around a block, by direction.
  struct Surroundings {
    std::array<Passage, kGridRayCount> out;         ///< from it to the next one; straight directions only
    std::array<Passage, kGridRayCount> then;        ///< on a diagonal d: after out[d - 1], on in direction d + 1
    std::array<Passage, kGridRayCount> afterwards;  ///< and after out[d + 1], on in direction d - 1
  };

  /// From a block to the next one in a straight direction (even).
  Passage passage(CellIndex block, std::size_t direction) const;

  Surroundings around(CellIndex block) const;

  /// From the piece of the block in which the agent is, by what is seen now; `direction` is straight (even).
  Passage passageFrom(const SeenGrid& seen, CellIndex agent, std::size_t direction) const;

  /// The block's cells that are not cut off from its largest piece or, if `inside` is given, from this cell of the
  /// block. Bit 4 * row + column, counted from the block's first cell.
  unsigned pieceOf(const SeenGrid& seen, CellIndex block, bool through_doubtful,
                   const CellIndex* inside = nullptr) const;

  /// First block of the window.
  CellIndex origin() const { return passages_.origin(); }
  bool contains(CellIndex block) const { return passages_.contains(block); }

  static constexpr std::size_t bytes() { return RollingWindow<kSide, 4>::bytes() + RollingWindow<kSide, 1>::bytes(); }

 private:
  class Marks;

  void updatePassage(const SeenGrid& seen, CellIndex first, std::size_t axis);
  void openRound(const SeenGrid& seen, CellIndex first, std::size_t axis);
  void setPassage(CellIndex first, std::size_t axis, Passage passage);
  bool isForgotten(CellIndex first, CellIndex second) const {
    return forgotten_.at(first) != 0 || forgotten_.at(second) != 0;
  }
  Passage judge(const SeenGrid& seen, CellIndex block, std::size_t direction, const CellIndex* inside) const;
  bool leadsRound(const SeenGrid& seen, CellIndex block, unsigned piece, CellIndex next, unsigned next_piece) const;
  bool isSeen(const SeenGrid& seen, CellIndex block) const;
  void noteForgotten(CellIndex old_origin, const SeenGrid& seen);

  RollingWindow<kSide, 4> passages_;   ///< two bits to the east and two to the north
  RollingWindow<kSide, 1> forgotten_;  ///< blocks whose cells have left the window of cells since they were judged
  CellIndex seen_origin_;
  CellIndex agent_;
  CellIndex goal_;
};

}  // namespace lstm_planner
