#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/observation.hpp"

namespace lstm_planner {

/// How often, and how long ago, a robot was at a place.
struct PlaceVisit {
  int count = 0;  ///< times that it came in; 0 = never, as far as it is remembered
  int age = 0;    ///< steps since it was there last; 0 = it is there now
};

/// Where the robot was, on three scales: a count and an age for each square of the floor, in the odometry frame.
///
/// Each scale has a fixed number of squares (a torus): a square uses the entry of the square that is a whole window
/// away, which is then forgotten. So the memory does not grow: 9 KiB.
class PlaceTrace {
 public:
  enum Scale { kStep = 0, kRoom = 1, kHall = 2 };
  static constexpr std::array<double, kPlaceScales> kCellSizes = {0.5, 1.5, 4.5};  ///< m
  static constexpr std::array<int, kPlaceScales> kWindowBits = {5, 5, 4};          ///< 2^bits squares each way
  static constexpr int kMostVisits = 8;                                            ///< more are counted as that many
  static constexpr int kLongestAge = 8000;  ///< steps; what is longer ago counts as that long at the least

  PlaceTrace();

  /// Forgets everything.
  void clear();

  /// The robot is at `position` (m), one step later. A visit counts for squares that it has just entered. Positions
  /// that are not finite, or more than 1,000 km away, are ignored.
  void visit(const Point2& position);

  /// About the square of `position`.
  PlaceVisit at(Scale scale, const Point2& position) const;

 private:
  /// What is remembered of a square.
  struct Entry {
    Entry() : Entry(0, 0) {}
    Entry(int place_column, int place_row) : column(place_column), row(place_row), count(0), stamp(0) {}
    std::int32_t column : 7;  ///< of the square, in windows: places some kilometres apart are taken for each other
    std::int32_t row : 7;
    std::uint32_t count : 4;
    std::uint32_t stamp : 14;
  };
  /// Where that stands.
  struct Place {
    std::size_t entry = 0;
    int column = 0;
    int row = 0;
    bool isOf(const Entry& entry_there) const { return entry_there.column == column && entry_there.row == row; }
  };
  /// False when the position is not finite or farther away than can be told.
  static bool placeOf(Scale scale, const Point2& position, Place* place);
  void forgetStamps();

  std::vector<Entry> entries_;
  int now_ = 0;  ///< counts the steps, as stamps do
};

}  // namespace lstm_planner
