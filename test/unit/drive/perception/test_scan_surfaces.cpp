#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lstm_planner/drive/perception/scan_surfaces.hpp"
#include "unit/drive/perception/room_scans.hpp"

namespace lstm_planner::test_scan_surfaces {
namespace {

constexpr double kNoise = 0.01;  // m
const Pose2 kMiddle{3.0, 2.0, 0.0};

std::vector<SurfacePiece> surfacesOf(const World& world, double spacing = 0.0, std::size_t most = 10000) {
  ScanSurfaces surfaces;
  surfaces.show(test::RoomScanner(world, 1, kNoise).seenFrom(kMiddle).profile);
  std::vector<SurfacePiece> pieces;
  surfaces.sample(spacing, most, &pieces);
  for (SurfacePiece& piece : pieces) piece.at = toParentFrame(kMiddle, piece.at);
  return pieces;
}

/// m from the nearest wall of a room of 6 m x 4 m, whose inner faces are at test::kWall; positive inside.
double distanceFromWalls(const Point2& at) {
  return std::min({at.x - test::kWall, 6.0 - test::kWall - at.x, at.y - test::kWall, 4.0 - test::kWall - at.y});
}

double distanceFromCorner(const Point2& at) {
  return std::hypot(std::min(at.x, 6.0 - at.x) - test::kWall, std::min(at.y, 4.0 - at.y) - test::kWall);
}

TEST(ScanSurfaces, LieOnTheWallsAndFaceTheScanner) {
  const std::vector<SurfacePiece> pieces = surfacesOf(test::room(6.0, 4.0));
  ASSERT_GT(pieces.size(), 500u);
  double squares = 0.0;
  for (const SurfacePiece& piece : pieces) {
    squares += square(distanceFromWalls(piece.at));
    EXPECT_NEAR(std::hypot(piece.normal.x, piece.normal.y), 1.0, 1e-9);
    if (distanceFromCorner(piece.at) < 0.25) continue;  // the piece of wall goes round it
    // A line through 20 returns or more on 0.4 m: 0.01 / (0.12 * sqrt(20)) = 0.02 rad; four times that.
    EXPECT_GT(std::max(std::abs(piece.normal.x), std::abs(piece.normal.y)), std::cos(0.08));
    EXPECT_GT(distanceFromWalls({piece.at.x + 0.1 * piece.normal.x, piece.at.y + 0.1 * piece.normal.y}), 0.05);
  }
  // Of 20 returns the mean is wrong by 0.01 / sqrt(20) = 0.0022 m, at the ends of a wall by twice that.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(pieces.size())), 0.0045) << "without noise: less than half of it";
}

TEST(ScanSurfaces, LeaveCornersOut) {
  for (const SurfacePiece& piece : surfacesOf(test::room(6.0, 4.0))) {
    EXPECT_GT(distanceBetween(piece.at, Point2{6.0 - test::kWall, 4.0 - test::kWall}), 0.04);
  }
}

TEST(ScanSurfaces, LeaveOutWhatFewBeamsHit) {
  EXPECT_TRUE(surfacesOf(CircleWorld({{{8.0, 2.0}, 0.03}, {{3.0, 7.0}, 0.03}})).empty()) << "three beams each";
}

TEST(ScanSurfaces, AreSampledAsFarApartAsAsked) {
  const std::vector<SurfacePiece> pieces = surfacesOf(test::room(6.0, 4.0), 0.3);
  EXPECT_GT(pieces.size(), 30u) << "of 16 m of walls, three quarters of which are in view";
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    EXPECT_GT(distanceBetween(pieces[i - 1].at, pieces[i].at), 0.25);
  }
  EXPECT_EQ(surfacesOf(test::room(6.0, 4.0), 0.0, 100).size(), 100u);
}

TEST(ScanSurfaces, AreFoundNearAPointOnly) {
  const GridWorld world = test::room(6.0, 4.0);
  ScanSurfaces surfaces;
  EXPECT_EQ(surfaces.nearest({1.0, 0.0}, 100.0), nullptr) << "of nothing";
  surfaces.show(test::RoomScanner(world).seenFrom(kMiddle).profile);
  const SurfacePiece* ahead = surfaces.nearest({2.9, 0.1}, 0.2);
  ASSERT_NE(ahead, nullptr);
  EXPECT_NEAR(ahead->at.x, 3.0 - test::kWall, 0.01);
  EXPECT_LT(ahead->normal.x, -0.99);
  EXPECT_EQ(surfaces.nearest({2.0, 0.1}, 0.2), nullptr) << "0.95 m before the wall";
  EXPECT_EQ(surfaces.nearest({-2.9, 0.0}, 0.2), nullptr) << "behind, where the scanner sees nothing";
}

TEST(ScanSurfaces, LieUnderPiecesThatFaceTheSameWay) {
  const GridWorld world = test::room(6.0, 4.0);
  ScanSurfaces surfaces;
  surfaces.show(test::RoomScanner(world).seenFrom(kMiddle).profile);
  const double wall = 3.0 - test::kWall;
  const SurfacePiece* under = surfaces.under({{wall - 0.08, 0.0}, {-1.0, 0.0}}, 0.1);
  ASSERT_NE(under, nullptr);
  EXPECT_NEAR(under->off({wall - 0.08, 0.0}), 0.08, 0.01);
  EXPECT_EQ(surfaces.under({{wall - 0.12, 0.0}, {-1.0, 0.0}}, 0.1), nullptr) << "0.12 m before the wall";
  EXPECT_EQ(surfaces.under({{wall, 0.0}, {1.0, 0.0}}, 0.1), nullptr) << "the back of a wall";
}

}  // namespace
}  // namespace lstm_planner::test_scan_surfaces
