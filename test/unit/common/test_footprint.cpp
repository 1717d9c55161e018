#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/common/footprint.hpp"

namespace lstm_planner::test_footprint {
namespace {

using ::testing::HasSubstr;

/// TurtleBot3 Waffle: its axle is in front of its middle.
Footprint waffle() { return Footprint({{-0.205, -0.145}, {-0.205, 0.145}, {0.077, 0.145}, {0.077, -0.145}}); }

std::string refusalOf(const std::string& text) {
  try {
    footprintOf("footprint", 0.2, text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Footprint, ACircleIsAsFarEverywhere) {
  const Footprint circle(0.2);
  EXPECT_TRUE(circle.isCircle());
  EXPECT_EQ(circle.inscribedRadius(), 0.2);
  EXPECT_EQ(circle.circumscribedRadius(), 0.2);
  EXPECT_EQ(circle.passingRadius(), 0.2);
  EXPECT_NEAR(circle.distanceTo({0.3, 0.4}), 0.3, 1e-15);
  EXPECT_NEAR(circle.distanceTo({}), -0.2, 1e-15);
}

TEST(Footprint, TheRadiiOfARectangleThatIsNotCentred) {
  const Footprint footprint = waffle();
  EXPECT_FALSE(footprint.isCircle());
  EXPECT_NEAR(footprint.inscribedRadius(), 0.077, 1e-9);                         // to the front
  EXPECT_NEAR(footprint.circumscribedRadius(), std::hypot(0.205, 0.145), 1e-9);  // to a rear corner
  EXPECT_NEAR(footprint.passingRadius(), 0.145, 1e-9);                           // half its width
}

TEST(Footprint, DistancesToSidesCornersAndFromInside) {
  const Footprint footprint = waffle();
  EXPECT_NEAR(footprint.distanceTo({0.177, 0.0}), 0.1, 1e-12);
  EXPECT_NEAR(footprint.distanceTo({0.077 + 0.03, 0.145 + 0.04}), 0.05, 1e-12);
  EXPECT_NEAR(footprint.distanceTo({0.0, -0.1}), -0.045, 1e-12);
}

TEST(Footprint, CornersMayComeInAnyOrderWithPointsInside) {
  const Footprint footprint({{0.2, 0.1}, {-0.2, -0.1}, {0.0, 0.0}, {0.2, -0.1}, {-0.2, 0.1}, {0.1, 0.05}});
  ASSERT_EQ(footprint.corners().size(), 4u);
  double area = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Point2& from = footprint.corners()[i];
    const Point2& to = footprint.corners()[(i + 1) % 4];
    area += 0.5 * (from.x * to.y - to.x * from.y);
  }
  EXPECT_NEAR(area, 0.4 * 0.2, 1e-12);  // positive: counter-clockwise
}

TEST(Footprint, GrowsByAMarginOnAllSides) {
  const Footprint grown = waffle().grown(0.03);
  EXPECT_NEAR(grown.distanceTo({0.107, 0.1}), 0.0, 1e-9);
  EXPECT_NEAR(grown.distanceTo({-0.235, -0.175}), 0.0, 1e-9);
  EXPECT_NEAR(Footprint(0.2).grown(0.03).inscribedRadius(), 0.23, 1e-12);
}

TEST(Footprint, IsReadAsCostmap2dWritesIt) {
  const Footprint footprint = footprintOf("footprint", 0.2, "[[0.2, 0.1], [-0.2, 0.1], [-0.2, -0.1], [0.2, -0.1]]");
  EXPECT_NEAR(footprint.passingRadius(), 0.1, 1e-12);
  EXPECT_TRUE(footprintOf("footprint", 0.2, "").isCircle());
  const Footprint again = footprintOf("footprint", 0.2, textOf(footprint));
  EXPECT_EQ(again.corners().size(), 4u);
  EXPECT_NEAR(again.circumscribedRadius(), std::hypot(0.2, 0.1), 1e-12);
}

TEST(Footprint, RefusesWhatIsNoFootprintAndSaysWhy) {
  EXPECT_THAT(refusalOf("0.2"), HasSubstr("parameter footprint is '0.2': expected [[x, y], [x, y], [x, y], ...] in m"));
  EXPECT_THAT(refusalOf("[[1, 2], [3"), HasSubstr("expected [[x, y], [x, y], [x, y], ...] in m"));
  EXPECT_THAT(refusalOf("[[a, b], [1, 2], [2, 3]]"), HasSubstr("expected [[x, y], [x, y], [x, y], ...] in m"));
  EXPECT_THAT(refusalOf("[[1, 2, 3], [1, 2], [2, 3]]"), HasSubstr("two numbers a corner"));
  EXPECT_THAT(refusalOf("[[0.1, 0], [0, 0.1]]"), HasSubstr("at least three corners"));
  EXPECT_THAT(refusalOf("[[0.1, 0.1], [0.2, 0.2], [-0.1, -0.1]]"), HasSubstr("at least three corners"));
  EXPECT_THAT(refusalOf("[[.inf, 0], [0, 0.1], [0, -0.1]]"), HasSubstr("within 100 m"));
  EXPECT_THAT(refusalOf("[[0.1, 0.1], [0.3, 0.1], [0.2, 0.3]]"), HasSubstr("around the robot's middle"));
  EXPECT_THROW(Footprint(0.0), std::invalid_argument);
  EXPECT_THROW(Footprint(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_footprint
