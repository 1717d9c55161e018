#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/common/footprint.hpp"
#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

class FootprintSweep;

/// Tells how far a footprint can be moved along a straight line or an arc, or turned in place, before it comes too near
/// to something that the scanner measured. Exact for the returns taken as points.
///
/// All points, poses and directions are in the base frame of the scan that was shown last. A circle turns in place
/// without moving: that is always free. The corners of a polygon sweep what is around it.
class Shield {
 public:
  /// `hard_margin`: m, see freeDistance(). `reach`: farthest obstacle that counts, m. Throws
  /// std::invalid_argument unless 0 <= margin and circumscribed radius + margin < reach.
  Shield(const Footprint& footprint, double hard_margin, double reach);

  /// Replaces what is known by the returns of one scan (base frame).
  void show(const std::vector<Point2>& obstacles);
  /// Adds others (base frame), until the next scan is shown.
  void add(const std::vector<Point2>& obstacles);

  /// From now on all is as seen from `pose` (base frame): the robot has moved since the scan.
  void moveTo(const Pose2& pose);

  /// Free length (m, at most `limit`) from `from` in `direction` (rad), and headed there, for the footprint grown by
  /// `clearance`. Inside the clearance the robot may drive past an obstacle but not approach it; inside the hard margin
  /// (or the clearance, if that is less) it may only retreat: else the noise of a scanner would let it come closer bit
  /// by bit. 0 when the first millimetre is blocked.
  double freeDistance(const Point2& from, double direction, double limit, double clearance) const;

  /// Whether the free distance is `length` (m).
  bool isFree(const Point2& from, double direction, double length, double clearance) const {
    return freeDistance(from, direction, length, clearance) >= length;
  }

  /// The same as freeDistance() along the arc that starts at the pose `from` with that curvature (1/m, positive to the
  /// left; 0 is the straight line). `length`: of the arc, m, negative for backwards, which is only for polygons: a
  /// circle turns round. Returns m, at most its magnitude. This is the path that a differential drive really takes when
  /// it is commanded linear and angular = curvature * linear.
  double freeArc(const Pose2& from, double curvature, double length, double clearance) const;

  /// The same for a turn in place by `angle` (rad, positive to the left): rad, at most its magnitude.
  double freeTurn(const Pose2& from, double angle, double clearance) const;

  /// Distance from the footprint at `from`, headed along x, to the nearest return, m; `reach` when nothing is that
  /// near.
  double gap(const Point2& from) const;

  /// The smallest gap() on that arc of that length (m, 0 or more); `reach` when nothing is that near.
  double arcGap(const Pose2& from, double curvature, double length) const;

  double footprintRadius() const { return footprint_radius_; }  ///< m, circumscribed
  const Footprint& footprint() const { return footprint_; }

 private:
  Footprint footprint_;
  double footprint_radius_;
  double hard_margin_;
  double reach_;

  /// Calls visit(obstacle) for all that are nearer than `distance`, and some others, until it answers true.
  template <typename Visit>
  void visitNear(const Point2& from, double distance, const Visit& visit) const;
  double nearest(const Point2& from) const;
  double sweep(const FootprintSweep& sweep, const Pose2& from, double limit, double clearance) const;
  double sweepGap(const FootprintSweep& sweep, const Pose2& from, double length) const;

  /// Some returns that follow one another, and the rectangle around them: neighbours in a scan lie near each other.
  struct Group {
    Point2 low;
    Point2 high;
    std::size_t end;  ///< one more than its last return
  };

  std::vector<Point2> returns_;  ///< within reach
  std::vector<Group> groups_;
};

}  // namespace lstm_planner
