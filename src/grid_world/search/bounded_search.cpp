#include "lstm_planner/grid_world/search/bounded_search.hpp"

#include <algorithm>

namespace lstm_planner {

void BoundedSearch::clear() {
  std::fill(reached_by_.begin(), reached_by_.end(), std::uint8_t{kUnreached << 4 | kUnreached});
  for (std::size_t entry = 0; entry < kMostOpen; ++entry) {
    open_[entry].next = (entry + 1 < kMostOpen ? static_cast<std::uint32_t>(entry + 1) : kNone) & 0xfffu;
  }
  free_ = 0;
  buckets_.fill(kNone);
}

void BoundedSearch::setReachedBy(int node, unsigned direction) {
  std::uint8_t& both = reached_by_[static_cast<std::size_t>(node / 2)];
  both = static_cast<std::uint8_t>((both & (node % 2 == 0 ? 0xf0u : 0x0fu)) | direction << (node % 2 * 4));
}

void BoundedSearch::push(int total, int node, std::size_t direction) {
  if (free_ == kNone) return;
  std::uint16_t& bucket = buckets_[static_cast<std::size_t>(total) % kBuckets];
  const std::uint16_t entry = free_;
  OpenNode& open = open_[entry];
  free_ = open.next;
  open.node = static_cast<std::uint32_t>(node) & 0xffffu;
  open.direction = static_cast<std::uint32_t>(direction) & 0xfu;
  open.next = bucket & 0xfffu;
  bucket = entry;
}

int BoundedSearch::pop(std::uint16_t* bucket) {
  const std::uint16_t entry = *bucket;
  OpenNode& open = open_[entry];
  *bucket = static_cast<std::uint16_t>(open.next);
  open.next = free_ & 0xfffu;
  free_ = entry;
  const int node = static_cast<int>(open.node);
  if (reachedBy(node) != kUnreached) return -1;
  setReachedBy(node, open.direction);
  ++expanded_;
  return node;
}

void BoundedSearch::pathTo(int node, std::size_t most, std::vector<std::uint8_t>* directions) const {
  const auto before = [&](int later) {
    const CellIndex step = kGridRaySteps[reachedBy(later)];
    return later - step.row * kSide - step.column;
  };
  directions->clear();
  std::size_t steps = 0;
  for (int at = node; reachedBy(at) != kRoot; at = before(at)) ++steps;
  for (; reachedBy(node) != kRoot; node = before(node)) {
    if (--steps < most) directions->push_back(reachedBy(node));
  }
  std::reverse(directions->begin(), directions->end());
}

}  // namespace lstm_planner
