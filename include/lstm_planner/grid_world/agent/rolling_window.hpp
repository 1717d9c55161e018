#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/base/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// A few bits for each place of a square window that rolls along over an endless plane, zero where nothing was set: the
/// window lies over the plane like a torus, so that nothing is copied when it rolls. `kBits` is 1, 2 or 4.
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

  /// Rolls in strides, no farther than needed for `place` to stay at least `margin` away from the window's edges.
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
    const std::size_t i = indexOf(place);
    return bytes_[i / kPlaces] >> (i % kPlaces * kBits) & kMask;
  }
  /// Does nothing outside.
  void set(CellIndex place, unsigned value) {
    if (!contains(place)) return;
    const std::size_t i = indexOf(place);
    const std::size_t shift = i % kPlaces * kBits;
    std::uint8_t& byte = bytes_[i / kPlaces];
    byte = static_cast<std::uint8_t>((byte & ~(kMask << shift)) | value << shift);
  }

  /// The values of as many places as a byte holds, side by side from `first` on, whose column is a multiple of that
  /// number; the first one in the lowest bits.
  unsigned byteFrom(CellIndex first) const {
    if (contains(first) && contains({first.column + kPlaces - 1, first.row})) return bytes_[indexOf(first) / kPlaces];
    unsigned byte = 0;
    for (int i = 0; i < kPlaces; ++i) byte |= at({first.column + i, first.row}) << (i * kBits);
    return byte;
  }

  static constexpr std::size_t bytes() { return static_cast<std::size_t>(kSide * kSide / kPlaces); }

 private:
  static constexpr int kPlaces = 8 / kBits;  ///< a byte
  static constexpr unsigned kMask = (1u << kBits) - 1u;
  static constexpr int kStride = 16;
  static_assert((kBits == 1 || kBits == 2 || kBits == 4) && kSide % kStride == 0, "whole bytes");

  static int onTorus(int i) { return ((i % kSide) + kSide) % kSide; }
  /// Of a place inside. From the origin's place on the torus, as a division would take longer than the rest.
  std::size_t indexOf(CellIndex place) const {
    const int column = on_torus_.column + place.column - origin_.column;
    const int row = on_torus_.row + place.row - origin_.row;
    return static_cast<std::size_t>((row < kSide ? row : row - kSide) * kSide +
                                    (column < kSide ? column : column - kSide));
  }

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
