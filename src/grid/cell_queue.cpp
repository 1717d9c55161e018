#include "lstm_planner/grid/cell_queue.hpp"

#include <algorithm>
#include <limits>

namespace lstm_planner {

namespace {

constexpr std::size_t kReservedChunks = 256;  // 16 kB, some 3500 cells
constexpr std::size_t kReservedLater = 1280;

/// Part of the buckets that is filled at once with what comes later: estimates go up by less than the rest at a time.
constexpr std::uint32_t kAtOnce = 512;

}  // namespace

CellQueue::CellQueue() {
  chunks_.reserve(kReservedChunks);
  later_.reserve(kReservedLater);
  clear(0);
}

void CellQueue::clear(std::uint32_t lowest) {
  buckets_.assign(kBuckets, kNoChunk);
  chunks_.clear();
  unused_ = kNoChunk;
  lowest_ = lowest;
  near_ = 0;
  later_.clear();
  lowest_later_ = std::numeric_limits<std::uint32_t>::max();
}

void CellQueue::push(std::uint32_t estimate, std::uint16_t column, std::uint16_t row) {
  if (estimate - lowest_ < kBuckets) {
    pushNear(estimate, {column, row});
  } else {
    later_.push_back({estimate, {column, row}});
    lowest_later_ = std::min(lowest_later_, estimate);
  }
}

bool CellQueue::lowest(std::uint32_t* estimate) {
  if (near_ > 0) {
    while (buckets_[lowest_ % kBuckets] == kNoChunk && lowest_ < lowest_later_) ++lowest_;
  }
  if (!later_.empty() && (near_ == 0 || lowest_ >= lowest_later_)) {
    fetchLater();
  }
  *estimate = lowest_;
  return near_ > 0;
}

void CellQueue::pop(std::uint16_t* column, std::uint16_t* row) {
  std::uint16_t& bucket = buckets_[lowest_ % kBuckets];
  const std::uint16_t first = bucket;
  Chunk& chunk = chunks_[first];
  const Cell& cell = chunk.cells[--chunk.count];
  *column = cell.column;
  *row = cell.row;
  if (chunk.count == 0) {
    bucket = chunk.next;
    chunk.next = unused_;
    unused_ = first;
  }
  --near_;
}

void CellQueue::pushNear(std::uint32_t estimate, const Cell& cell) {
  std::uint16_t& bucket = buckets_[estimate % kBuckets];
  if (bucket == kNoChunk || chunks_[bucket].count == chunks_[bucket].cells.size()) {
    bucket = newChunk(bucket);
  }
  Chunk& chunk = chunks_[bucket];
  chunk.cells[chunk.count++] = cell;
  ++near_;
}

void CellQueue::fetchLater() {
  lowest_ = lowest_later_;
  lowest_later_ = std::numeric_limits<std::uint32_t>::max();
  std::size_t left = 0;
  for (const Later& later : later_) {
    if (later.estimate - lowest_ < kAtOnce) {
      pushNear(later.estimate, later.cell);
    } else {
      lowest_later_ = std::min(lowest_later_, later.estimate);
      later_[left++] = later;
    }
  }
  later_.resize(left);
}

std::uint16_t CellQueue::newChunk(std::uint16_t next) {
  std::uint16_t chunk = unused_;
  if (chunk == kNoChunk) {
    chunk = static_cast<std::uint16_t>(chunks_.size());
    if (chunks_.size() == chunks_.capacity()) {
      chunks_.reserve(chunks_.size() + kReservedChunks);  // searches from all along the border need thousands
    }
    chunks_.emplace_back();
  } else {
    unused_ = chunks_[chunk].next;
  }
  chunks_[chunk].count = 0;
  chunks_[chunk].next = next;
  return chunk;
}

}  // namespace lstm_planner
