#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lstm_planner {

/// Priority queue of cells for a search whose estimates are small integers that never decrease. The cell with the
/// smallest estimate comes first; of equal ones, the one that was added last. There is a bucket for each estimate.
///
/// Memory is reserved at the start, and grows if a search needs more.
class CellQueue {
 public:
  CellQueue();

  /// Removes all cells. No later estimate may be less than `lowest`.
  void clear(std::uint32_t lowest);

  /// `estimate` must not be less than that of the last pop().
  void push(std::uint32_t estimate, std::uint16_t column, std::uint16_t row);

  /// The smallest estimate. Returns false if the queue is empty.
  bool lowest(std::uint32_t* estimate);

  /// Removes a cell with the smallest estimate. lowest() must have been called before.
  void pop(std::uint16_t* column, std::uint16_t* row);

 private:
  static constexpr std::uint32_t kBuckets = 1024;
  static constexpr std::uint16_t kNoChunk = 0xffff;

  /// Indices in the grid.
  struct Cell {
    std::uint16_t column;
    std::uint16_t row;
  };
  /// A piece of a bucket, as large as a cache line.
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

  std::vector<std::uint16_t> buckets_;  ///< first chunk of each bucket; index: estimate modulo the number of buckets
  std::vector<Chunk> chunks_;
  std::uint16_t unused_ = kNoChunk;  ///< first free chunk
  std::uint32_t lowest_ = 0;
  std::uint32_t near_ = 0;    ///< number of cells in buckets
  std::vector<Later> later_;  ///< cells with estimates beyond the buckets
  std::uint32_t lowest_later_ = 0;
};

}  // namespace lstm_planner
