#include "lstm_planner/agent/place_trace.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {
namespace {

constexpr std::size_t kEntries = static_cast<std::size_t>(PlaceTrace::kWindow * PlaceTrace::kWindow);
constexpr double kFarthest = 1e6;  ///< m from the origin
constexpr int kLastStamp = (1 << 14) - 1;
constexpr int kWindowBits = 7;

/// The lowest bits of a number of windows, with its sign.
int wrapped(int windows) {
  constexpr int kRange = 1 << kWindowBits;
  return ((windows + kRange / 2) & (kRange - 1)) - kRange / 2;
}

}  // namespace

PlaceTrace::PlaceTrace() : entries_(kPlaceScales * kEntries) {}

void PlaceTrace::clear() {
  std::fill(entries_.begin(), entries_.end(), Entry{});
  now_ = 0;
}

bool PlaceTrace::placeOf(Scale scale, const Point2& position, Place* place) {
  if (!(std::abs(position.x) < kFarthest && std::abs(position.y) < kFarthest)) return false;
  const double size = kCellSizes[static_cast<std::size_t>(scale)];
  const int column = static_cast<int>(std::floor(position.x / size));
  const int row = static_cast<int>(std::floor(position.y / size));
  static_assert((kWindow & (kWindow - 1)) == 0, "remainders are taken by bits, of negative numbers as well");
  const int inside = (row & (kWindow - 1)) * kWindow + (column & (kWindow - 1));
  const auto windows = [](int index) { return index >= 0 ? index / kWindow : -1 - (-1 - index) / kWindow; };
  place->entry = static_cast<std::size_t>(scale) * kEntries + static_cast<std::size_t>(inside);
  place->column = wrapped(windows(column));
  place->row = wrapped(windows(row));
  return true;
}

/// Makes room for later stamps; ages up to kLongestAge stay as they are.
void PlaceTrace::forgetStamps() {
  const int oldest = now_ - kLongestAge;
  for (Entry& entry : entries_) {
    entry.stamp = static_cast<std::uint32_t>(std::max(0, static_cast<int>(entry.stamp) - oldest)) & kLastStamp;
  }
  now_ -= oldest;
}

void PlaceTrace::visit(const Point2& position) {
  std::array<Place, kPlaceScales> places;
  for (std::size_t scale = 0; scale < places.size(); ++scale) {
    if (!placeOf(static_cast<Scale>(scale), position, &places[scale])) return;
  }
  if (now_ == kLastStamp) forgetStamps();
  const auto before = static_cast<std::uint32_t>(now_++);
  for (const Place& place : places) {
    Entry& entry = entries_[place.entry];
    if (!place.isOf(entry)) entry = Entry(place.column, place.row);
    const bool stays = entry.count > 0 && entry.stamp == before;
    if (!stays) entry.count = std::min<std::uint32_t>(kMostVisits, entry.count + 1u) & 0xfu;
    entry.stamp = static_cast<std::uint32_t>(now_) & kLastStamp;
  }
}

PlaceVisit PlaceTrace::at(Scale scale, const Point2& position) const {
  Place place;
  if (!placeOf(scale, position, &place)) return {};
  const Entry& entry = entries_[place.entry];
  if (entry.count == 0 || !place.isOf(entry)) return {};
  return {static_cast<int>(entry.count), now_ - static_cast<int>(entry.stamp)};
}

std::size_t PlaceTrace::bytes() { return sizeof(PlaceTrace) + kPlaceScales * kEntries * sizeof(Entry); }

}  // namespace lstm_planner
