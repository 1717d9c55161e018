#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lstm_planner/simulation/moving_cylinders.hpp"

namespace lstm_planner::test_moving_cylinders {
namespace {

constexpr double kPeriod = 0.02;
constexpr Point2 kRobot{11.0, 0.0};
constexpr Pose2 kFarAway{1000.0, 0.0, 0.0};

class MovingCylindersTest : public ::testing::Test {
 protected:
  MovingCylinders cylinders(const MovingCylindersParameters& parameters, std::uint64_t seed) const {
    return MovingCylinders(floor_, parameters, kRobot, seed);
  }

  const GridWorld floor_{cylindersFloor()};
  const Footprint robot_{0.2};
};

TEST_F(MovingCylindersTest, StartAtLeastThreeMetresFromTheRobot) {
  MovingCylindersParameters many;
  many.cylinders = 50;
  const MovingCylinders moving = cylinders(many, 1);
  for (const Circle& body : moving.circles()) {
    EXPECT_GE(distanceBetween(body.center, kRobot), 3.0 + body.radius);
  }
}

TEST_F(MovingCylindersTest, StayInTheSquareAndWithinTheirSpeeds) {
  MovingCylindersParameters parameters;
  parameters.cylinders = 10;
  parameters.order = 3;
  MovingCylinders moving = cylinders(parameters, 2);
  long steps = 0;
  long restarts = 0;
  for (double time = 0.0; time < 60.0; time += kPeriod) {
    const std::vector<Circle> before = moving.circles();
    moving.advance(kPeriod, robot_, kFarAway);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Point2 now = moving.circles()[i].center;
      EXPECT_LE(std::abs(now.x), kCylindersArea + 1e-9);
      EXPECT_LE(std::abs(now.y), kCylindersArea + 1e-9);
      const double speed = distanceBetween(before[i].center, now) / kPeriod;
      ++steps;
      if (speed > parameters.fastest + 1e-9) ++restarts;
      // A bend is cut by at most its chord.
      if (speed < 0.9 * parameters.slowest) ++restarts;
    }
  }
  EXPECT_LT(restarts, steps / 100) << "only where a cylinder starts anew it jumps";
}

TEST_F(MovingCylindersTest, OfFirstOrderMoveAlongStraightLines) {
  MovingCylindersParameters parameters;
  parameters.cylinders = 5;
  parameters.order = 1;
  MovingCylinders moving = cylinders(parameters, 3);
  const std::vector<Circle> start = moving.circles();
  moving.advance(0.1, robot_, kFarAway);
  const std::vector<Circle> then = moving.circles();
  for (int i = 0; i < 20; ++i) moving.advance(0.1, robot_, kFarAway);
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Point2 now = moving.circles()[i].center;
    EXPECT_NEAR(directionTo(start[i].center, then[i].center), directionTo(start[i].center, now), 1e-9);
  }
}

TEST_F(MovingCylindersTest, MeetARobotOnceEachTime) {
  MovingCylindersParameters parameters;
  parameters.cylinders = 1;
  parameters.order = 1;
  MovingCylinders moving = cylinders(parameters, 4);
  const Point2 start = moving.circles()[0].center;
  moving.advance(0.1, robot_, kFarAway);
  const double direction = directionTo(start, moving.circles()[0].center);
  const Point2 ahead = pointAlong(start, direction, 2.0);
  std::size_t meetings = 0;
  for (int i = 0; i < 40; ++i) meetings += moving.advance(0.1, robot_, {ahead.x, ahead.y, 0.0}).size();
  EXPECT_EQ(meetings, 1u);
}

TEST_F(MovingCylindersTest, AreTheSameForTheSameSeed) {
  const MovingCylindersParameters parameters;
  EXPECT_EQ(cylinders(parameters, 7).circles()[3].center.x, cylinders(parameters, 7).circles()[3].center.x);
  EXPECT_NE(cylinders(parameters, 7).circles()[3].center.x, cylinders(parameters, 8).circles()[3].center.x);
}

TEST_F(MovingCylindersTest, HaveTheNumbersAndMotionsOfThePublishedClasses) {
  for (int number = 0; number < 3 * kDynaBarnWorldsAClass; ++number) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const MovingCylindersParameters drawn = drawMovingCylinders(number, seed);
      const bool is_hard = drawn.order >= 3;
      EXPECT_GE(drawn.order, 1);
      EXPECT_LE(drawn.order, 4);
      EXPECT_EQ(drawn.slowest, is_hard ? 1.0 : 0.5);
      EXPECT_EQ(drawn.fastest, is_hard ? 2.0 : 1.0);
      EXPECT_GE(drawn.spread, is_hard ? 0.1 : 0.01);
      EXPECT_LE(drawn.spread, is_hard ? 0.2 : 0.1);
      const bool may_be_many = drawn.cylinders >= 10 && drawn.cylinders <= 20;
      const bool may_be_few = drawn.cylinders >= 5 && drawn.cylinders <= 10;
      switch (dynaBarnClassOf(number)) {
        case DynaBarnClass::kEasy:
          EXPECT_TRUE(may_be_few && !is_hard);
          break;
        case DynaBarnClass::kMedium:
          EXPECT_TRUE(is_hard ? may_be_few : may_be_many);
          break;
        case DynaBarnClass::kHard:
          EXPECT_TRUE(may_be_many && is_hard);
          break;
      }
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_moving_cylinders
