#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lstm_planner {

/// Cells to look at, those with the smallest estimate first and of these the last one: a queue of buckets, one for each
/// estimate, as a search needs it whose estimates are small integers that never go down.
///
/// The memory needed is reserved; a search that needs more makes it grow once and for all.
class CellQueue {
 public:
  CellQueue();

  /// Nothing is left; no estimate will be less than `lowest`.
  void clear(std::uint32_t lowest);

  /// `estimate`: at least that of the last pop().
  void push(std::uint32_t estimate, std::uint16_t column, std::uint16_t row);

  /// The smallest estimate; false when there is none.
  bool lowest(std::uint32_t* estimate);

  /// Takes one of those with the lowest() estimate, which must have been asked for.
  void pop(std::uint16_t* column, std::uint16_t* row);

 private:
  static constexpr std::uint32_t kBuckets = 1024;
  static constexpr std::uint16_t kNoChunk = 0xffff;

  /// Indices in the grid.
  struct Cell {
    std::uint16_t column;
    std::uint16_t row;
  };
  /// A piece of a bucket, as large as a line of the cache.
  struct Chunk {
    std::array<Cell, 15> cells;
    std::uint16_t count;
    std::uint16_t next;
  };
  /// One whose estimate is beyond all buckets.
  struct Later {
    std::uint32_t estimate;
    Cell cell;
  };

  void pushNear(std::uint32_t estimate, const Cell& cell);
  void fetchLater();
  std::uint16_t newChunk(std::uint16_t next);

  std::vector<std::uint16_t> buckets_;  ///< first chunk, by estimate modulo their number
  std::vector<Chunk> chunks_;
  std::uint16_t unused_ = kNoChunk;  ///< first of the chunks that are free
  std::uint32_t lowest_ = 0;
  std::uint32_t near_ = 0;    ///< cells in buckets
  std::vector<Later> later_;  ///< with estimates beyond the buckets
  std::uint32_t lowest_later_ = 0;
};

}  // namespace lstm_planner
