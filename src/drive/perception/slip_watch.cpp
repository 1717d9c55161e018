#include "lstm_planner/drive/perception/slip_watch.hpp"

#include <cmath>

namespace lstm_planner {

namespace {

constexpr double kOnSurface = 0.1;       ///< m between a piece and the line of the surface that it lies on
constexpr double kTells = 0.15;          ///< m that the odometry's motion would move a piece off its line
constexpr int kFewestPieces = 6;         ///< that tell
constexpr double kMostStay = 0.7;        ///< of these lie where they lay, at least,
constexpr double kHardlyMove = 0.35;     ///< and where they would if the robot had moved, at most
constexpr double kDrivenForABit = 0.25;  ///< m

/// Whether the scan was taken from where `before` was, and not from there after `motion`.
bool looksTheSame(const std::vector<SurfacePiece>& pieces, const ScanSurfaces& before, const Pose2& motion) {
  int telling = 0;
  int stay = 0;
  int move = 0;
  for (const SurfacePiece& piece : pieces) {
    const SurfacePiece moved = inParentFrame(motion, piece);
    if (std::abs(moved.off(piece.at)) < kTells) continue;
    ++telling;
    stay += before.under(piece, kOnSurface) != nullptr ? 1 : 0;
    move += before.under(moved, kOnSurface) != nullptr ? 1 : 0;
  }
  return telling >= kFewestPieces && stay >= kMostStay * telling && move <= kHardlyMove * telling;
}

}  // namespace

void SlipWatch::clear() {
  times_ = 0;
  slipped_ = 0.0;
  stood_ = odometry_;
}

bool SlipWatch::note(const std::vector<SurfacePiece>& pieces, const ScanSurfaces& surfaces, const Pose2& odometry) {
  const Pose2 motion = compose(inverse(odometry_), odometry);
  const double distance = std::hypot(motion.x, motion.y);
  const bool is_same = has_scan_ && looksTheSame(pieces, surfaces_, motion);
  if (is_same) {
    ++times_;
    slipped_ += distance + std::abs(motion.yaw);
  } else {
    // A turn on the spot, as of a recovery, does not show that the robot gets away.
    if (times_ < kSure || distance >= kDrivenForABit) clear();
    stood_ = odometry;
  }
  has_scan_ = true;
  surfaces_ = surfaces;
  odometry_ = odometry;
  return is_same;
}

Pose2 SlipWatch::takeBack() {
  if (times_ < kSure) return {};
  const Pose2 back = compose(stood_, inverse(odometry_));
  stood_ = odometry_;
  return back;
}

}  // namespace lstm_planner
