#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/geometry.hpp"
#include "lstm_planner/perception/observation.hpp"

namespace lstm_planner {

/// How often the robot was where: a count for each square of the floor, in the odometry frame.
///
/// The squares lie over the plane like a torus of fixed size: a square takes the entry of another that lies a whole
/// window away, which is then forgotten. The memory does not grow.
class PlaceTrace {
 public:
  static constexpr double kCellSize = 0.5;  ///< m; about a step
  static constexpr int kWindow = 64;        ///< squares each way: 32 m
  static constexpr int kMostVisits = 8;     ///< more are counted as that many

  PlaceTrace();

  /// Forgets everything.
  void clear();

  /// The robot is at `position` now, m. Counts when it has come from another square. What is not finite is ignored.
  void visit(const Point2& position);

  /// Times that the robot came into the square of `position`, as far as it is remembered.
  int at(const Point2& position) const;

  /// at() for the places `radius` metres from the robot in the directions heading + i * 45 degrees.
  std::array<double, kPlaceDirections> around(const Pose2& pose, double radius) const;

  static std::size_t bytes();

 private:
  struct Entry {
    Entry() : Entry(0, 0, 0) {}
    Entry(int place_column, int place_row, unsigned visits) : column(place_column), row(place_row), count(visits) {}
    std::int32_t column : 12;  ///< of the square, in windows
    std::int32_t row : 12;
    std::uint32_t count : 8;
  };
  struct Place {
    std::size_t entry = 0;
    std::int16_t column = 0;
    std::int16_t row = 0;
    bool operator==(const Place& other) const {
      return entry == other.entry && column == other.column && row == other.row;
    }
  };
  /// False when the position is not finite or farther away than can be told.
  static bool placeOf(const Point2& position, Place* place);

  std::vector<Entry> entries_;
  Place here_;
  bool is_somewhere_ = false;
};

}  // namespace lstm_planner
