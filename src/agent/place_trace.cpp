#include "lstm_planner/agent/place_trace.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {
namespace {

constexpr int kEntries = PlaceTrace::kWindow * PlaceTrace::kWindow;

/// m; a thousand windows from the origin.
constexpr double kFarthest = 1000.0 * PlaceTrace::kWindow * PlaceTrace::kCellSize;

}  // namespace

PlaceTrace::PlaceTrace() : entries_(kEntries) {}

void PlaceTrace::clear() {
  std::fill(entries_.begin(), entries_.end(), Entry{});
  is_somewhere_ = false;
}

bool PlaceTrace::placeOf(const Point2& position, Place* place) {
  if (!(std::abs(position.x) < kFarthest && std::abs(position.y) < kFarthest)) return false;
  const int column = static_cast<int>(std::floor(position.x / kCellSize));
  const int row = static_cast<int>(std::floor(position.y / kCellSize));
  const auto window_of = [](int index) { return index >= 0 ? index / kWindow : -1 - (-1 - index) / kWindow; };
  const int window_column = window_of(column);
  const int window_row = window_of(row);
  place->entry = static_cast<std::size_t>((row - window_row * kWindow) * kWindow + (column - window_column * kWindow));
  place->column = static_cast<std::int16_t>(window_column);
  place->row = static_cast<std::int16_t>(window_row);
  return true;
}

void PlaceTrace::visit(const Point2& position) {
  Place place;
  if (!placeOf(position, &place) || (is_somewhere_ && place == here_)) return;
  here_ = place;
  is_somewhere_ = true;
  Entry& entry = entries_[place.entry];
  if (entry.column != place.column || entry.row != place.row) entry = Entry(place.column, place.row, 0);
  entry.count = static_cast<std::uint8_t>(std::min(kMostVisits, static_cast<int>(entry.count) + 1));
}

int PlaceTrace::at(const Point2& position) const {
  Place place;
  if (!placeOf(position, &place)) return 0;
  const Entry& entry = entries_[place.entry];
  return entry.column == place.column && entry.row == place.row ? static_cast<int>(entry.count) : 0;
}

std::array<double, kPlaceDirections> PlaceTrace::around(const Pose2& pose, double radius) const {
  std::array<double, kPlaceDirections> visits{};
  for (int i = 0; i < kPlaceDirections; ++i) {
    visits[static_cast<std::size_t>(i)] = at(pointAlong(pose, pose.yaw + i * M_PI_4, radius));
  }
  return visits;
}

std::size_t PlaceTrace::bytes() { return sizeof(PlaceTrace) + kEntries * sizeof(Entry); }

}  // namespace lstm_planner
