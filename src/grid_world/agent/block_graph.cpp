#include "lstm_planner/grid_world/agent/block_graph.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "grid_world/agent/block_patch.hpp"

namespace lstm_planner {
namespace {

constexpr std::size_t kEast = 0;
constexpr std::size_t kNorth = 2;

bool isIn(CellIndex cell, CellIndex block) { return blockOf(cell) == block; }

unsigned bitOf(CellIndex cell, CellIndex block) {
  const CellIndex first = firstCellOf(block);
  return 1u << ((cell.row - first.row) * kBlockSide + cell.column - first.column);
}

/// The cells of `open` that can be reached from `from` by straight moves.
unsigned filled(unsigned from, unsigned open) {
  constexpr unsigned kNotFirstColumn = 0xeeee;
  constexpr unsigned kNotLastColumn = 0x7777;
  for (;;) {
    const unsigned wider = (from | (from << 1 & kNotFirstColumn) | (from >> 1 & kNotLastColumn) | from << kBlockSide |
                            from >> kBlockSide) &
                           open;
    if (wider == from) return from;
    from = wider;
  }
}

int countOf(unsigned cells) {
  int count = 0;
  for (; cells != 0; cells &= cells - 1) ++count;
  return count;
}

unsigned largestPiece(unsigned open) {
  unsigned best = 0;
  for (unsigned left = open; left != 0;) {
    const unsigned piece = filled(left & (~left + 1), open);
    if (countOf(piece) > countOf(best)) best = piece;
    left &= ~piece;
  }
  return best;
}

/// Those of a block's cells that lie at its side in a straight direction: four bits, at the same places for the
/// opposite side of the block beside it.
unsigned sideOf(unsigned cells, std::size_t direction) {
  constexpr unsigned kColumn = 0x1111;
  constexpr unsigned kRow = 0xf;
  constexpr int kLast = kBlockSide - 1;
  if (direction == 0) return cells >> kLast & kColumn;
  if (direction == 2) return cells >> kLast * kBlockSide & kRow;
  return cells & (direction == 4 ? kColumn : kRow);
}

}  // namespace

/// Passages that a change may have changed, each once however many changes there were: bits by column of the blocks
/// whose cells are remembered, row by row, with room for the blocks around them.
class BlockGraph::Marks {
 public:
  using Row = std::uint64_t;

  explicit Marks(CellIndex seen_origin) {
    const CellIndex first = blockOf(seen_origin);
    low_ = {first.column - kRoom, first.row - kRoom};
  }

  /// What the cells of a block are part of: the passages from it and to it, and those around which it may lead.
  void changed(CellIndex block) {
    const int column = block.column - low_.column;
    const int row = block.row - low_.row;
    if (column < kRoom || row < kRoom || column >= kSide - kRoom || row >= kSide - kRoom) return;
    for (int i = -2; i <= 1; ++i) {
      const auto beside = static_cast<std::size_t>(row + i);
      const auto bits = [&](Row from_two_before) { return from_two_before << (column - 2); };
      if (i == 0) anew_[kEastAxis][beside] |= bits(0b1110);
      if (i >= -1) anew_[kNorthAxis][beside] |= bits(0b0100);
      if (i >= -1) round_[kEastAxis][beside] |= bits(0b1111);
      round_[kNorthAxis][beside] |= bits(0b1110);
    }
  }

  /// visit(block, axis, whether it is to be judged anew; else it may only have been opened)
  template <typename Visit>
  void visit(const Visit& visit) const {
    for (std::size_t row = 0; row < kSide; ++row) {
      for (const std::size_t axis : {kEastAxis, kNorthAxis}) {
        const Row anew = anew_[axis][row];
        Row left = anew | round_[axis][row];
        for (int column = 0; left != 0; ++column, left >>= 1) {
          if ((left & 1) == 0) continue;
          const CellIndex block{low_.column + column, low_.row + static_cast<int>(row)};
          visit(block, axis == kEastAxis ? kEast : kNorth, (anew >> column & 1) != 0);
        }
      }
    }
  }

 private:
  static constexpr int kRoom = 2;
  static constexpr int kSide = SeenGrid::kSide / kBlockSide + 1 + 2 * kRoom;
  static_assert(kSide <= 64, "a row fits");
  static constexpr std::size_t kEastAxis = 0;
  static constexpr std::size_t kNorthAxis = 1;
  using Rows = std::array<Row, kSide>;

  CellIndex low_;
  std::array<Rows, 2> anew_{};
  std::array<Rows, 2> round_{};
};

void BlockGraph::restart(const SeenGrid& seen, CellIndex agent) {
  passages_.restart(blockOf(agent));
  forgotten_.restart(blockOf(agent));
  seen_origin_ = seen.origin();
  agent_ = agent;
  goal_ = agent;
}

void BlockGraph::update(const SeenGrid& seen, CellIndex agent, CellIndex goal) {
  passages_.keepInside(blockOf(agent), kMargin);
  forgotten_.keepInside(blockOf(agent), kMargin);
  if (seen.origin() != seen_origin_) noteForgotten(seen_origin_, seen);
  agent_ = agent;
  Marks marks(seen.origin());
  if (goal != goal_) {
    marks.changed(blockOf(goal_));
    marks.changed(blockOf(goal));
    goal_ = goal;
  }
  for (const CellIndex block : seen.changedBlocks()) marks.changed(block);
  marks.visit([&](CellIndex block, std::size_t axis, bool anew) {
    // What the window of the cells has forgotten is not judged anew.
    if (!isSeen(seen, block)) return;
    anew ? updatePassage(seen, block, axis) : openRound(seen, block, axis);
  });
}

bool BlockGraph::isSeen(const SeenGrid& seen, CellIndex block) const {
  return seen.contains(firstCellOf({block.column - 1, block.row - 1})) &&
         seen.contains(firstCellOf({block.column + 2, block.row + 2}));
}

void BlockGraph::noteForgotten(CellIndex old_origin, const SeenGrid& seen) {
  const CellIndex first = blockOf(old_origin);
  for (int row = 0; row <= SeenGrid::kSide / kBlockSide; ++row) {
    for (int column = 0; column <= SeenGrid::kSide / kBlockSide; ++column) {
      const CellIndex block = {first.column + column, first.row + row};
      if (!isSeen(seen, block)) forgotten_.set(block, 1);
    }
  }
  seen_origin_ = seen.origin();
}

BlockGraph::Passage BlockGraph::passage(CellIndex block, std::size_t direction) const {
  const bool forward = direction == kEast || direction == kNorth;
  const CellIndex first = forward ? block : cellBeside(block, static_cast<int>(direction));
  const unsigned both = passages_.at(first);
  return static_cast<Passage>(direction % 4 == kEast ? both & 3u : both >> 2);
}

BlockGraph::Surroundings BlockGraph::around(CellIndex block) const {
  const std::array<unsigned, 9> beside = passages_.around(block);
  const auto at = [&](int columns, int rows) { return beside[static_cast<std::size_t>((rows + 1) * 3 + columns + 1)]; };
  const auto east = [](unsigned both) { return static_cast<Passage>(both & 3u); };
  const auto north = [](unsigned both) { return static_cast<Passage>(both >> 2); };
  const unsigned here = at(0, 0);
  const unsigned west = at(-1, 0);
  const unsigned south = at(0, -1);
  const unsigned south_west = at(-1, -1);
  constexpr Passage kNone = Passage::kClosed;
  Surroundings all{};
  all.out = {east(here), kNone, north(here), kNone, east(west), kNone, north(south), kNone};
  all.then = {kNone, north(at(1, 0)), kNone, east(at(-1, 1)), kNone, north(south_west), kNone, east(south)};
  all.afterwards = {kNone, east(at(0, 1)), kNone, north(west), kNone, east(south_west), kNone, north(at(1, -1))};
  return all;
}

BlockGraph::Passage BlockGraph::passageFrom(const SeenGrid& seen, CellIndex agent, std::size_t direction) const {
  return judge(seen, blockOf(agent), direction, &agent);
}

unsigned BlockGraph::pieceOf(const SeenGrid& seen, CellIndex block, bool through_doubtful,
                             const CellIndex* inside) const {
  const SeenGrid::BlockCells cells = seen.cellsOf(block);
  const unsigned open = kWholeBlock & ~(cells.wall | (through_doubtful ? 0u : cells.doubtful));
  if (open == kWholeBlock) return open;
  unsigned from = 0;
  // Through doubtful cells it grows, but stays the same piece.
  if (through_doubtful) from = pieceOf(seen, block, false, inside);
  if (from == 0 && inside != nullptr) from = bitOf(*inside, block) & open;
  if (from == 0 && isIn(goal_, block)) from = bitOf(goal_, block) & open;
  return from != 0 ? filled(from, open) : largestPiece(open);
}

void BlockGraph::setPassage(CellIndex first, std::size_t axis, Passage passage) {
  const unsigned both = passages_.at(first);
  const unsigned value = static_cast<unsigned>(passage);
  passages_.set(first, axis == kEast ? (both & ~3u) | value : (both & 3u) | value << 2);
}

void BlockGraph::updatePassage(const SeenGrid& seen, CellIndex first, std::size_t axis) {
  const CellIndex second = cellBeside(first, static_cast<int>(axis));
  Passage judged = judge(seen, first, axis, nullptr);
  const bool walked = judged == Passage::kFree && (isIn(agent_, first) || isIn(agent_, second));
  if (isForgotten(first, second) && !walked) judged = std::max(passage(first, axis), judged);
  setPassage(first, axis, judged);
}

/// A passage that looked closed is open where a block beside it shows a way round. Passages that are open need not be
/// judged again for that: what was seen free stays free.
void BlockGraph::openRound(const SeenGrid& seen, CellIndex first, std::size_t axis) {
  if (passage(first, axis) <= Passage::kFree) return;
  const CellIndex second = cellBeside(first, static_cast<int>(axis));
  if (isForgotten(first, second)) return;
  if (leadsRound(seen, first, pieceOf(seen, first, false), second, pieceOf(seen, second, false))) {
    setPassage(first, axis, Passage::kFree);
  }
}

BlockGraph::Passage BlockGraph::judge(const SeenGrid& seen, CellIndex block, std::size_t direction,
                                      const CellIndex* inside) const {
  const CellIndex next = cellBeside(block, static_cast<int>(direction));
  const std::size_t back = (direction + kGridRayCount / 2) % kGridRayCount;
  const unsigned here = pieceOf(seen, block, false, inside);
  const unsigned there = pieceOf(seen, next, false);
  if (const unsigned passable = sideOf(here, direction) & sideOf(there, back); passable != 0) {
    const unsigned free = sideOf(seen.cellsOf(block).free, direction) & sideOf(seen.cellsOf(next).free, back);
    return (passable & free) != 0 ? Passage::kFree : Passage::kUnknown;
  }
  if (leadsRound(seen, block, here, next, there)) return Passage::kFree;
  const unsigned doubtful_here = pieceOf(seen, block, true, inside);
  const unsigned doubtful_there = pieceOf(seen, next, true);
  const bool doubtful = (sideOf(doubtful_here, direction) & sideOf(doubtful_there, back)) != 0;
  return doubtful ? Passage::kDoubtful : Passage::kClosed;
}

/// Whether cells that were seen free lead from one piece to the other through the blocks around the two.
bool BlockGraph::leadsRound(const SeenGrid& seen, CellIndex block, unsigned piece, CellIndex next,
                            unsigned next_piece) const {
  if ((piece & seen.cellsOf(block).free) == 0 || (next_piece & seen.cellsOf(next).free) == 0) return false;
  const CellIndex low = {std::min(block.column, next.column) - 1, std::min(block.row, next.row) - 1};
  const CellIndex high = {std::max(block.column, next.column) + 1, std::max(block.row, next.row) + 1};
  BlockPatch free;
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      free.add(seen.cellsOf({column, row}).free, {column - low.column, row - low.row});
    }
  }
  BlockPatch from;
  from.add(piece, {block.column - low.column, block.row - low.row});
  BlockPatch to;
  to.add(next_piece, {next.column - low.column, next.row - low.row});
  return from.leadsTo(to, free);
}

}  // namespace lstm_planner
