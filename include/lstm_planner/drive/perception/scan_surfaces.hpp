#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// A piece of a wall, or of something else that is straight for about 0.4 m.
struct SurfacePiece {
  Point2 at;      ///< m
  Point2 normal;  ///< unit vector to the side that the scanner sees; (0, 0): there is no surface

  /// How far a point is off its line, m; positive on the side of the normal.
  double off(const Point2& point) const { return normal.x * (point.x - at.x) + normal.y * (point.y - at.y); }
};

/// The piece in the frame in which `pose` is given.
inline SurfacePiece inParentFrame(const Pose2& pose, const SurfacePiece& piece) {
  return {toParentFrame(pose, piece.at), toParentFrame({0.0, 0.0, pose.yaw}, piece.normal)};
}

/// The surfaces that a scan shows. Each return gets the line through its neighbours:
///
///              normal
///                 ^
///       .   . ____|____ .   .     returns with noise, and the line through them
///             '  at   '
///
/// and moves onto it, which takes most of the noise away. Corners, walls that are seen at a grazing angle, and what
/// fewer than five beams hit show no surface. All is in the base frame of the scan.
class ScanSurfaces {
 public:
  /// Takes the surfaces of a scan in place of those before.
  void show(const RangeProfile& profile);

  /// The piece nearest to `point` among those that lie in nearly the same direction from the scanner; null when none is
  /// within `distance` (m).
  const SurfacePiece* nearest(const Point2& point, double distance) const;

  /// The piece near by that faces the same way as `piece`, which is off its line by `distance` (m) at most; null if
  /// there is none.
  const SurfacePiece* under(const SurfacePiece& piece, double distance) const;

  /// Pieces that are about `spacing` (m) apart; at most `most`, which are taken evenly from all.
  void sample(double spacing, std::size_t most, std::vector<SurfacePiece>* pieces) const;

 private:
  Point2 origin_;                     ///< of the scanner
  double first_direction_ = 0.0;      ///< rad, of the first beam
  double increment_ = 0.0;            ///< rad
  std::vector<SurfacePiece> pieces_;  ///< one a beam
};

}  // namespace lstm_planner
