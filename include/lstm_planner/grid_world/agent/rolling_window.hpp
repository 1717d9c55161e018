#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// A few bits for each place of a square window that moves over an endless plane; 0 where nothing was set. Places are
/// stored as on a torus, so that nothing is copied when the window moves. `kBits` is 1, 2 or 4.
template <int kWindowSide, int kBits>
class RollingWindow {
 public:
  static constexpr int kSide = kWindowSide;

  RollingWindow() : bytes_(static_cast<std::size_t>(kSide * kSide / kPlaces)) {}

  /// Forgets everything and puts `middle` in the middle.
  void restart(CellIndex middle) {
    std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{0});
    origin_ = {middle.column - kSide / 2, middle.row - kSide / 2};
    on_torus_ = {onTorus(origin_.column), onTorus(origin_.row)};
  }

  /// Moves the window, in strides of 16 places, until `place` is at least `margin` places away from its edges.
  void keepInside(CellIndex place, int margin) {
    rollAlong(place.column, margin, &CellIndex::column);
    rollAlong(place.row, margin, &CellIndex::row);
  }

  CellIndex origin() const { return origin_; }
  bool contains(CellIndex place) const {
    return place.column >= origin_.column && place.row >= origin_.row && place.column < origin_.column + kSide &&
           place.row < origin_.row + kSide;
  }
  /// 0 outside.
  unsigned at(CellIndex place) const {
    if (!contains(place)) return 0;
    return valueAt(indexOf(place));
  }
  /// Does nothing outside.
  void set(CellIndex place, unsigned value) {
    if (!contains(place)) return;
    const std::size_t i = indexOf(place);
    const std::size_t shift = i % kPlaces * kBits;
    std::uint8_t& byte = bytes_[i / kPlaces];
    byte = static_cast<std::uint8_t>((byte & ~(kMask << shift)) | value << shift);
  }

  /// The values of four rows from `first` on, a byte a row, the first row in the lowest bits. `first.column` must be a
  /// multiple of the number of places in a byte.
  std::uint32_t fourBytesFrom(CellIndex first) const {
    const bool inside = contains(first) && contains({first.column + kPlaces - 1, first.row + 3});
    std::uint32_t bytes = 0;
    for (int row = 0; row < 4; ++row) {
      const CellIndex place{first.column, first.row + row};
      if (inside) {
        bytes |= std::uint32_t{bytes_[indexOf(place) / kPlaces]} << (8 * row);
        continue;
      }
      for (int i = 0; i < kPlaces; ++i) bytes |= at({place.column + i, place.row}) << (8 * row + i * kBits);
    }
    return bytes;
  }

  /// The values of a place and of those beside it: nine, row by row.
  std::array<unsigned, 9> around(CellIndex place) const {
    std::array<unsigned, 9> values;
    const bool inside = contains({place.column - 1, place.row - 1}) && contains({place.column + 1, place.row + 1});
    if (!inside) {
      for (int i = 0; i < 9; ++i) {
        values[static_cast<std::size_t>(i)] = at({place.column + i % 3 - 1, place.row + i / 3 - 1});
      }
      return values;
    }
    const std::size_t columns[3] = {columnOf(place.column - 1), columnOf(place.column), columnOf(place.column + 1)};
    std::size_t next = 0;
    for (int row = place.row - 1; row <= place.row + 1; ++row) {
      const std::size_t first = rowOf(row) * kSide;
      for (const std::size_t column : columns) values[next++] = valueAt(first + column);
    }
    return values;
  }

  static constexpr std::size_t bytes() { return static_cast<std::size_t>(kSide * kSide / kPlaces); }

 private:
  static constexpr int kPlaces = 8 / kBits;  ///< a byte
  static constexpr unsigned kMask = (1u << kBits) - 1u;
  static constexpr int kStride = 16;
  static_assert((kBits == 1 || kBits == 2 || kBits == 4) && kSide % kStride == 0, "whole bytes");

  static int onTorus(int i) { return ((i % kSide) + kSide) % kSide; }
  // Of a place inside. From the origin's place on the torus, as a division would take longer than the rest.
  std::size_t columnOf(int column) const { return wrapped(on_torus_.column + column - origin_.column); }
  std::size_t rowOf(int row) const { return wrapped(on_torus_.row + row - origin_.row); }
  static std::size_t wrapped(int i) { return static_cast<std::size_t>(i < kSide ? i : i - kSide); }
  std::size_t indexOf(CellIndex place) const { return rowOf(place.row) * kSide + columnOf(place.column); }
  unsigned valueAt(std::size_t index) const { return bytes_[index / kPlaces] >> (index % kPlaces * kBits) & kMask; }

  void rollAlong(int place, int margin, int CellIndex::*axis) {
    while (place < origin_.*axis + margin) moveOrigin(-1, axis);
    while (place >= origin_.*axis + kSide - margin) moveOrigin(1, axis);
  }

  void moveOrigin(int sign, int CellIndex::*axis) {
    // What leaves on one side makes room for what comes in on the other.
    const int first = sign > 0 ? origin_.*axis : origin_.*axis + kSide - kStride;
    for (int i = 0; i < kStride; ++i) {
      for (int j = 0; j < kSide; ++j) {
        CellIndex place = origin_;
        place.*axis = first + i;
        (axis == &CellIndex::column ? place.row : place.column) += j;
        set(place, 0);
      }
    }
    origin_.*axis += sign * kStride;
    on_torus_.*axis = onTorus(origin_.*axis);
  }

  CellIndex origin_;
  CellIndex on_torus_;  ///< where the origin lies
  std::vector<std::uint8_t> bytes_;
};

}  // namespace lstm_planner
