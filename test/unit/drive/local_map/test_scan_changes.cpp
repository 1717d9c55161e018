#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "lstm_planner/drive/local_map/scan_changes.hpp"

namespace lstm_planner::test_scan_changes {
namespace {

constexpr double kReach = 10.0;
constexpr double kResolution = 0.05;

/// The squares of returns at some places (base frame) around a robot in the middle of a window of 30 m.
class ReturnSquares : public ::testing::Test {
 protected:
  ReturnSquares() { window_.moveTo(pose_); }

  std::vector<Square> squaresOf(const std::vector<Point2>& places) {
    Situation situation;
    situation.pose = pose_;
    situation.obstacles = places;
    ScanChanges changes(kReach);
    changes.find(situation, window_);
    std::vector<Square> squares;
    for (const std::uint32_t key : changes.returns()) squares.push_back(squareOf(key));
    return squares;
  }

  /// Whether a square holds the place, but for what is lost in floats: a thousandth of a square.
  bool holds(const Square& square, const Point2& place) const {
    const Point2 center = window_.centerOf(square);
    const Point2 at = toParentFrame(pose_, place);
    return std::max(std::abs(at.x - center.x), std::abs(at.y - center.y)) <= 0.501 * kResolution;
  }

  const Pose2 pose_{3.01, -7.02, 0.4};
  ObstacleWindow window_{30.0, kResolution};
};

TEST_F(ReturnSquares, AreThoseOfTheReturnsWithinReachInTheirOrder) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-12.0, 12.0);
  std::vector<Point2> places;
  for (int i = 0; i < 1081; ++i) places.push_back({coordinate(random), coordinate(random)});
  const std::vector<Square> squares = squaresOf(places);
  std::size_t next = 0;
  for (const Point2& place : places) {
    if (std::hypot(place.x, place.y) > kReach) continue;
    ASSERT_LT(next, squares.size());
    EXPECT_TRUE(holds(squares[next], place)) << next;
    ++next;
  }
  EXPECT_EQ(next, squares.size());
}

TEST_F(ReturnSquares, StandOnceWhereReturnsFollowOneAnotherInASquare) {
  EXPECT_EQ(squaresOf({{1.0, 2.0}, {1.001, 2.0}, {5.0, 2.0}, {1.0, 2.0}}).size(), 3u);
}

TEST_F(ReturnSquares, AreNoneOfPlacesThatAreTooFarForAWholeNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double huge : {1.2e8, -1e10, 1e19, 1e300, kInf, -kInf, kNan}) {
    EXPECT_TRUE(squaresOf({{huge, 1.0}, {1.0, huge}, {huge, huge}}).empty()) << huge;
  }
}

TEST_F(ReturnSquares, AreNoneOutsideTheWindow) {
  window_.moveTo({pose_.x - 8.0, pose_.y, 0.0});  // the robot is 7 m from the window's right edge
  EXPECT_EQ(squaresOf({{-5.0, 2.0}, {9.9, 0.0}, {9.0, -4.0}}).size(), 1u);
}

}  // namespace
}  // namespace lstm_planner::test_scan_changes
