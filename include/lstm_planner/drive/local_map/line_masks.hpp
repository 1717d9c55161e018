#pragma once

#include <cstdint>
#include <vector>

namespace lstm_planner {

/// For straight paths between the middles of squares that are not far apart: which squares' middles lie nearer to the
/// path than a radius. A path is free when none of them is occupied: a few bits of each row tell.
class LineMasks {
 public:
  /// `longest`: columns and rows between the ends of a path at most.
  explicit LineMasks(int longest) : longest_(longest) {}

  /// Radius in squares. Masks are 64 squares wide: longest + 2 * radius must be less than that.
  void setRadius(double radius);

  /// Whole squares beside and around an end that a mask reaches to.
  int margin() const { return margin_; }

  /// For the path from a square to that `columns` to the right and `rows` up, 0 or more: the bits of the rows from
  /// margin() below the start to margin() above the end; the lowest bit is margin() to the left of the leftmost end.
  const std::uint64_t* mask(int columns, int rows) const {
    return &masks_[static_cast<std::size_t>(rows * (2 * longest_ + 1) + columns + longest_) *
                   static_cast<std::size_t>(longest_ + 1 + 2 * margin_)];
  }

 private:
  int longest_;
  int margin_ = 0;
  std::vector<std::uint64_t> masks_;
};

}  // namespace lstm_planner
