#include "lstm_planner/drive/decision/place_trace.hpp"

#include <algorithm>
#include <cmath>

#include "drive/local_map/bounded_rounding.hpp"
#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {
namespace {

constexpr double kFarthest = 2.0 * kFarthestPose;  ///< m from the origin; what lies around poses is asked for, too
constexpr int kLastStamp = (1 << 14) - 1;
constexpr int kNumberBits = 7;

/// The lowest bits of a number of windows, with its sign.
int wrapped(int windows) {
  constexpr int kRange = 1 << kNumberBits;
  return ((windows + kRange / 2) & (kRange - 1)) - kRange / 2;
}

/// Where the entries of a scale start; of one more than there are, where all end.
constexpr std::size_t firstEntry(std::size_t scale) {
  std::size_t entries = 0;
  for (std::size_t before = 0; before < scale; ++before) {
    entries += std::size_t{1} << (2 * PlaceTrace::kWindowBits[before]);
  }
  return entries;
}

}  // namespace

PlaceTrace::PlaceTrace() : entries_(firstEntry(kPlaceScales)) {}

void PlaceTrace::clear() {
  std::fill(entries_.begin(), entries_.end(), Entry{});
  now_ = 0;
}

bool PlaceTrace::placeOf(Scale scale, const Point2& position, Place* place) {
  if (!(std::abs(position.x) < kFarthest && std::abs(position.y) < kFarthest)) return false;
  const double size = kCellSizes[static_cast<std::size_t>(scale)];
  const int bits = kWindowBits[static_cast<std::size_t>(scale)];
  const int last = (1 << bits) - 1;
  const int column = floorOf(position.x / size);
  const int row = floorOf(position.y / size);
  const int inside = ((row & last) << bits) + (column & last);
  place->entry = firstEntry(static_cast<std::size_t>(scale)) + static_cast<std::size_t>(inside);
  place->column = wrapped(column >> bits);
  place->row = wrapped(row >> bits);
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

}  // namespace lstm_planner
