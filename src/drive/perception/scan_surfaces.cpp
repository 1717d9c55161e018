#include "lstm_planner/drive/perception/scan_surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {

namespace {

constexpr double kPieceRadius = 0.2;   ///< m, within which neighbours belong to a piece
constexpr double kPieceBeams = 3.0;    ///< to both sides that belong to it at least
constexpr long kMostBeamsASide = 40;   ///< of a piece: a wall beside the scanner has hundreds
constexpr double kFewestReturns = 5;   ///< that show a direction
constexpr double kRoughest = 0.025;    ///< m, root mean square distance of the returns from the line
constexpr double kMostGrazing = 0.1;   ///< cosine of the angle between beam and normal
constexpr long kSearchedBeams = 3;     ///< to both sides of a direction
constexpr double kNearestWall = 1e-3;  ///< m
constexpr double kAside = 0.1;         ///< m that a piece may lie farther off along the wall
constexpr double kSameNormal = 0.9;    ///< cosine

/// Sums over returns, for the line through them.
struct Moments {
  double count = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;

  /// Relative to a place near by: squares of large numbers would leave nothing of small differences.
  void add(double dx, double dy) {
    count += 1.0;
    x += dx;
    y += dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
};

/// The line through the returns as a piece at `at`, which they are relative to; without a normal if they are on no
/// line, or it is seen at a grazing angle.
SurfacePiece pieceOf(const Moments& sums, const Point2& at, const Point2& scanner) {
  const double x = sums.x / sums.count;
  const double y = sums.y / sums.count;
  const double xx = sums.xx / sums.count - x * x;
  const double xy = sums.xy / sums.count - x * y;
  const double yy = sums.yy / sums.count - y * y;
  const double across = 0.5 * (xx + yy) - 0.5 * std::hypot(xx - yy, 2.0 * xy);  // the smaller variance
  if (across > square(kRoughest)) return {at, {}};
  const double along = 0.5 * std::atan2(2.0 * xy, xx - yy);
  Point2 normal{-std::sin(along), std::cos(along)};
  const Point2 beam{scanner.x - at.x, scanner.y - at.y};
  const double towards = normal.x * beam.x + normal.y * beam.y;
  if (std::abs(towards) < kMostGrazing * std::hypot(beam.x, beam.y)) return {at, {}};
  if (towards < 0.0) normal = {-normal.x, -normal.y};
  const double off = normal.x * x + normal.y * y;
  return {{at.x + off * normal.x, at.y + off * normal.y}, normal};
}

bool isSurface(const SurfacePiece& piece) { return piece.normal.x != 0.0 || piece.normal.y != 0.0; }

double squaredDistance(const Point2& a, const Point2& b) { return square(a.x - b.x) + square(a.y - b.y); }

/// The returns of a scan, from which pieces are made.
class NeighbouringReturns {
 public:
  explicit NeighbouringReturns(const RangeProfile& profile) : profile_(profile), at_(profile.ranges.size()) {
    for (std::size_t beam = 0; beam < at_.size(); ++beam) {
      if (!profile.isMeasured(beam)) continue;
      at_[beam] = pointAlong(profile.origin, profile.direction(beam), profile.ranges[beam]);
    }
  }

  SurfacePiece pieceAt(long beam) const {
    if (!isReturn(beam)) return {};
    const Point2& at = at_[static_cast<std::size_t>(beam)];
    // The beams of a coarse scanner lie far apart on a far wall.
    const double width = distanceBetween(profile_.origin, at) * std::abs(profile_.increment);
    const double radius = std::max(kPieceRadius, kPieceBeams * width);
    Moments sums;
    sums.add(0.0, 0.0);
    for (const long side : {-1, 1}) {
      for (long step = 1; step <= kMostBeamsASide && isReturn(beam + side * step); ++step) {
        const Point2& there = at_[static_cast<std::size_t>(beam + side * step)];
        if (squaredDistance(there, at) > square(radius)) break;
        sums.add(there.x - at.x, there.y - at.y);
      }
    }
    return sums.count >= kFewestReturns ? pieceOf(sums, at, profile_.origin) : SurfacePiece{at, {}};
  }

 private:
  bool isReturn(long beam) const {
    return beam >= 0 && beam < static_cast<long>(at_.size()) && profile_.isMeasured(static_cast<std::size_t>(beam));
  }

  const RangeProfile& profile_;
  std::vector<Point2> at_;  ///< one a beam
};

}  // namespace

void ScanSurfaces::show(const RangeProfile& profile) {
  origin_ = profile.origin;
  first_direction_ = profile.first_direction;
  increment_ = profile.increment;
  const NeighbouringReturns returns(profile);
  pieces_.resize(profile.ranges.size());
  for (std::size_t beam = 0; beam < pieces_.size(); ++beam) pieces_[beam] = returns.pieceAt(static_cast<long>(beam));
}

const SurfacePiece* ScanSurfaces::nearest(const Point2& point, double distance) const {
  if (pieces_.empty()) return nullptr;
  double beams = normalizeAngle(directionTo(origin_, point) - first_direction_) / increment_;
  if (beams < -0.5) beams += kFullTurn / std::abs(increment_);
  const long middle = std::lround(beams);
  const long last = std::min(static_cast<long>(pieces_.size()) - 1, middle + kSearchedBeams);
  const SurfacePiece* best = nullptr;
  double nearest = square(distance);
  for (long beam = std::max(0L, middle - kSearchedBeams); beam <= last; ++beam) {
    const SurfacePiece& piece = pieces_[static_cast<std::size_t>(beam)];
    const double there = squaredDistance(piece.at, point);
    if (there > nearest || !isSurface(piece)) continue;
    nearest = there;
    best = &piece;
  }
  return best;
}

const SurfacePiece* ScanSurfaces::under(const SurfacePiece& piece, double distance) const {
  const SurfacePiece* surface = nearest(piece.at, distance + kAside);
  if (surface == nullptr || std::abs(surface->off(piece.at)) > distance) return nullptr;
  const double cosine = piece.normal.x * surface->normal.x + piece.normal.y * surface->normal.y;
  return cosine < kSameNormal ? nullptr : surface;
}

void ScanSurfaces::sample(double spacing, std::size_t most, std::vector<SurfacePiece>* pieces) const {
  pieces->clear();
  std::size_t beam = 0;
  while (beam < pieces_.size()) {
    const SurfacePiece& piece = pieces_[beam];
    if (!isSurface(piece)) {
      ++beam;
      continue;
    }
    pieces->push_back(piece);
    // By angle, not by the distance from the last piece: noise would decide which one is far enough, on a wall that
    // recedes another than on one that comes nearer, and each match would turn the robot a little to the same side.
    const double width = std::max(kNearestWall, distanceBetween(origin_, piece.at) * std::abs(increment_));
    beam += static_cast<std::size_t>(std::max(1.0, std::ceil(spacing / width)));
  }
  if (pieces->size() <= most) return;
  for (std::size_t i = 0; i < most; ++i) (*pieces)[i] = (*pieces)[i * pieces->size() / most];
  pieces->resize(most);
}

}  // namespace lstm_planner
