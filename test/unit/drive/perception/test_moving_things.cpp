#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "lstm_planner/drive/perception/moving_things.hpp"

namespace lstm_planner::test_moving_things {
namespace {

constexpr double kPeriod = 0.05;

/// What a scanner in the origin sees of discs, in the order of its beams: the near half of each.
class MovingThingsTest : public ::testing::Test {
 protected:
  struct Disc {
    Point2 center;
    double radius;
    bool moves;
  };
  void sense(const std::vector<Disc>& discs) {
    std::vector<Point2> returns;
    std::vector<std::uint8_t> moves;
    for (const Disc& disc : discs) {
      const double back = directionTo(disc.center, Point2{});
      for (double angle = 0.5; angle >= -0.5; angle -= 0.05) {
        returns.push_back(pointAlong(disc.center, back + angle * M_PI, disc.radius));
        moves.push_back(disc.moves ? 1 : 0);
      }
    }
    things_.show(returns, moves, time_);
    time_ += kPeriod;
  }

  MovingThings things_;
  double time_ = 10.0;
};

TEST_F(MovingThingsTest, MeasuresHowFastEachOfTwoThingsIs) {
  for (int i = 0; i < 10; ++i) {
    const double t = kPeriod * i;
    sense({{{4.0 - 1.5 * t, 2.0}, 0.5, true}, {{5.0, -2.0 + 0.4 * t}, 0.25, true}});
  }
  const std::vector<MovingThing> seen = things_.around({});
  ASSERT_EQ(seen.size(), 2u);
  // A tenth of the speed: the half that is seen turns with the thing's bearing.
  EXPECT_NEAR(seen[0].velocity.x, -1.5, 0.15);
  EXPECT_NEAR(seen[0].velocity.y, 0.0, 0.15);
  EXPECT_NEAR(seen[0].radius, 0.5, 0.01);
  EXPECT_NEAR(seen[1].velocity.x, 0.0, 0.04);
  EXPECT_NEAR(seen[1].velocity.y, 0.4, 0.04);
  EXPECT_NEAR(seen[1].radius, 0.25, 0.01);
}

TEST_F(MovingThingsTest, AnswersInTheFrameOfTheRobot) {
  for (int i = 0; i < 10; ++i) sense({{{4.0, 1.0 * kPeriod * i}, 0.3, true}});
  const std::vector<MovingThing> seen = things_.around({1.0, 0.0, M_PI_2});
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0].velocity.x, 1.0, 0.1);
  EXPECT_NEAR(seen[0].velocity.y, 0.0, 0.1);
  EXPECT_NEAR(seen[0].center.y, -2.9, 0.35);  // the middle of what is seen lies up to a radius before the centre
}

TEST_F(MovingThingsTest, WhatStandsIsNoMovingThing) {
  for (int i = 0; i < 10; ++i) sense({{{4.0, 0.0}, 0.3, false}});
  EXPECT_TRUE(things_.around({}).empty());
}

TEST_F(MovingThingsTest, OneSightTellsNoVelocity) {
  sense({{{4.0, 0.0}, 0.3, true}});
  EXPECT_TRUE(things_.around({}).empty());
}

TEST_F(MovingThingsTest, WhatGoesOutOfSightGoesOnForAWhileAndIsThenForgotten) {
  for (int i = 0; i < 10; ++i) sense({{{4.0, 1.0 * kPeriod * i}, 0.3, true}});
  for (int i = 10; i < 30; ++i) sense({});
  const std::vector<MovingThing> seen = things_.around({});
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0].center.y, 1.0 * kPeriod * 29, 0.15);
  for (int i = 30; i < 45; ++i) sense({});  // 1.75 s without it
  EXPECT_TRUE(things_.around({}).empty());
}

TEST_F(MovingThingsTest, ATimeThatGoesBackForgetsAll) {
  for (int i = 0; i < 10; ++i) sense({{{4.0, 1.0 * kPeriod * i}, 0.3, true}});
  time_ = 1.0;
  sense({});
  EXPECT_TRUE(things_.around({}).empty());
}

}  // namespace
}  // namespace lstm_planner::test_moving_things
