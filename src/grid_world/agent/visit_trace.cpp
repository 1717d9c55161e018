#include "lstm_planner/grid_world/agent/visit_trace.hpp"

#include <algorithm>
#include <limits>

namespace lstm_planner {
namespace {

constexpr int kMostVisits = std::numeric_limits<std::uint8_t>::max();
constexpr std::uint16_t kLastStamp = std::numeric_limits<std::uint16_t>::max();

/// log2 of the blocks' and of the windows' sizes.
constexpr std::array<int, VisitTrace::kScales> kBlockShifts = {0, 2, 3};
constexpr std::array<int, VisitTrace::kScales> kWindowShifts = {5, 5, 6};
constexpr std::array<std::size_t, VisitTrace::kScales> kFirstEntries = {0, 1024, 2048};
constexpr std::size_t kEntries = 2048 + 4096;

CellIndex blockOf(VisitTrace::Scale scale, CellIndex cell) {
  return {cell.column >> kBlockShifts[scale], cell.row >> kBlockShifts[scale]};
}

}  // namespace

VisitTrace::VisitTrace() : entries_(kEntries) { clear(); }

void VisitTrace::clear() {
  std::fill(entries_.begin(), entries_.end(), Entry{});
  now_ = 0;
  blocks_.fill({std::numeric_limits<int>::min(), 0});
}

VisitTrace::Place VisitTrace::placeOf(Scale scale, CellIndex cell) {
  const CellIndex block = blockOf(scale, cell);
  const int shift = kWindowShifts[scale];
  const int mask = (1 << shift) - 1;
  const std::size_t entry =
      kFirstEntries[scale] + static_cast<std::size_t>(((block.row & mask) << shift) | (block.column & mask));
  const int tag = (((block.row >> shift) & 15) << 4) | ((block.column >> shift) & 15);
  return {entry, static_cast<std::uint8_t>(tag)};
}

bool VisitTrace::visit(CellIndex cell) {
  // Stamps have 16 bits: once in 65,535 steps everything is forgotten, rather than taken for new.
  if (now_ == kLastStamp) clear();
  ++now_;
  bool is_new = false;
  for (const Scale scale : {kCell, kSmallBlock, kLargeBlock}) {
    const Place place = placeOf(scale, cell);
    Entry& entry = entries_[place.entry];
    is_new = entry.count == 0 || entry.tag != place.tag;
    if (is_new) entry = {now_, 0, place.tag};
    const CellIndex block = blockOf(scale, cell);
    CellIndex& last = blocks_[scale];
    const bool stayed = block.column == last.column && block.row == last.row;
    if ((!stayed || entry.count == 0) && entry.count < kMostVisits) ++entry.count;
    entry.stamp = now_;
    last = block;
  }
  return is_new;
}

Visit VisitTrace::at(Scale scale, CellIndex cell) const {
  const Place place = placeOf(scale, cell);
  const Entry& entry = entries_[place.entry];
  if (entry.count == 0 || entry.tag != place.tag) return {};
  return {entry.count, now_ - entry.stamp};
}

std::size_t VisitTrace::bytes() { return sizeof(VisitTrace) + kEntries * sizeof(Entry); }

}  // namespace lstm_planner
