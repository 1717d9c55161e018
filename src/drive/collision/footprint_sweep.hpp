#pragma once

#include <vector>

#include "lstm_planner/common/footprint.hpp"

namespace lstm_planner {

/// What a polygon sweeps while it moves along a straight line or turns about a point, against single points: exact.
///
/// The motion starts at the base frame's origin, forward along x or backward, with the centre of the turn at
/// (0, 1/curvature); a turn in place has it at the origin. How far it goes is told in m of the origin's path, in rad
/// for a turn in place.
class FootprintSweep {
 public:
  /// Straight on, or back.
  static FootprintSweep straight(const Footprint& footprint, bool back) { return {footprint, 0.0, false, back, false}; }
  /// Along an arc of that curvature (1/m, positive to the left). One that is nearly 0 is a straight line.
  static FootprintSweep arc(const Footprint& footprint, double curvature, bool back);
  /// In place, to the left or right.
  static FootprintSweep turn(const Footprint& footprint, bool left) { return {footprint, 0.0, !left, false, true}; }

  /// How far it goes until it is as near as `distance` (m) to a point that is farther away now, at most `limit`.
  double freeBefore(const Point2& point, double distance, double limit) const;

  /// The least distance to a point on the path, m, 0 where they overlap.
  double leastDistance(const Point2& point, double length) const;

  /// Now, m; negative inside.
  double distanceTo(const Point2& point) const { return footprint_.distanceTo(mirrored(point)); }

  /// How far the origin goes in a motion of that length, m.
  double pathOf(double length) const { return turns_ ? 0.0 : length; }

  /// Whether the motion's first instant makes that smaller.
  bool comesNearer(const Point2& point) const;

 private:
  FootprintSweep(const Footprint& footprint, double radius, bool mirror_side, bool mirror_front, bool turns);

  Point2 mirrored(const Point2& point) const {
    return {mirror_front_ ? -point.x : point.x, mirror_side_ ? -point.y : point.y};
  }
  bool isStraight() const { return !turns_ && radius_ <= 0.0; }
  double freeStraight(const Point2& point, double distance, double limit) const;
  double freeTurn(const Point2& point, double distance, double limit) const;
  /// Calls note(place) for each point of the outline, grown by `distance`, at the same distance from the turning centre
  /// as `point`.
  template <typename Note>
  void meet(const Point2& point, double distance, const Note& note) const;
  /// Where a place is around the centre of the turn, in the sense of the turn from below the centre, rad.
  double angleOf(const Point2& place) const;
  /// The place at that angle, so far (m) from the centre.
  Point2 placeAt(double angle, double around) const;
  /// An angle as a length of the motion.
  double lengthOf(double angle) const { return turns_ ? angle : radius_ * angle; }

  Footprint footprint_;  ///< mirrored, such that all motion is forward and to the left
  double radius_;        ///< m, of the arc; 0 for a straight line, and for a turn in place
  bool mirror_side_;
  bool mirror_front_;
  bool turns_;
};

}  // namespace lstm_planner
