#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lstm_planner/simulation/crowd.hpp"
#include "support/refusal.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_crowd {
namespace {

constexpr double kPeriod = 0.02;  // s
constexpr Pose2 kNowhere{1e6, 1e6, 0.0};

class InAHall : public ::testing::Test {
 protected:
  Crowd crowd(std::uint64_t seed, int walkers = 10) const {
    CrowdParameters parameters;
    parameters.walkers = walkers;
    return Crowd(hall, places, parameters, {5.0, 5.0}, seed);
  }

  const GridWorld hall{test::emptyHall(10.0, 10.0)};
  const std::vector<Point2> places = standingPlaces(hall, 0.3);
};

using CrowdTest = InAHall;

TEST_F(CrowdTest, BeginsAwayFromTheRobotAndOffTheWalls) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Crowd people = crowd(seed);
    for (const Circle& body : people.circles()) {
      EXPECT_GE(distanceBetween(body.center, Point2{5.0, 5.0}), 1.0 + body.radius);
      EXPECT_FALSE(hall.touches(body.center, body.radius));
      EXPECT_GE(body.radius, 0.2);
      EXPECT_LE(body.radius, 0.3);
    }
    for (const Crowd::Walker& walker : people.walkers()) {
      EXPECT_GE(walker.speed, 0.3);
      EXPECT_LE(walker.speed, 1.0);
    }
  }
}

TEST_F(CrowdTest, WalksAtItsSpeedAndNeverThroughAWall) {
  Crowd people = crowd(3);
  std::vector<double> walked(people.walkers().size(), 0.0);
  for (int i = 0; i < 3000; ++i) {
    const std::vector<Circle> before = people.circles();
    people.advance(kPeriod, Footprint(0.01), kNowhere);
    for (std::size_t k = 0; k < before.size(); ++k) {
      const Circle& body = people.circles()[k];
      const double path = distanceBetween(before[k].center, body.center);
      ASSERT_LE(path, people.walkers()[k].speed * kPeriod + 1e-12);
      ASSERT_FALSE(hall.touches(body.center, body.radius));
      walked[k] += path;
    }
  }
  for (std::size_t k = 0; k < walked.size(); ++k) {
    // In a minute it arrives a dozen times at the most, and loses less than a step each time.
    EXPECT_NEAR(walked[k], people.walkers()[k].speed * 60.0, 0.02 * people.walkers()[k].speed * 60.0);
  }
}

TEST_F(CrowdTest, StandsBeforeTheRobotAndThenGoesElsewhere) {
  Crowd people = crowd(5, 1);
  // In the walker's way, half a metre of air between them.
  const Circle body = people.circles()[0];
  const Point2 destination = people.walkers()[0].destination;
  const double distance = body.radius + 0.17425 + 0.5;
  const Point2 ahead = pointAlong(body.center, directionTo(body.center, destination), distance);
  ASSERT_GT(distanceBetween(body.center, destination), distance);
  const Footprint robot({{0.1, 0.17}, {0.1, -0.17}, {-0.1, -0.17}, {-0.1, 0.17}});
  const Pose2 pose{ahead.x, ahead.y, 0.3};
  double stood = 0.0;
  int meetings = 0;
  for (double time = 0.0; time < 60.0; time += kPeriod) {
    meetings += static_cast<int>(people.advance(kPeriod, robot, pose).size());
    ASSERT_GE(airBetween(robot, pose, people.circles()[0]), 0.0);
    stood += people.walkers()[0].standing > 0.0 ? kPeriod : 0.0;
    if (meetings == 1 && !people.isBesideRobot(0)) break;
  }
  EXPECT_EQ(meetings, 1);
  EXPECT_GE(stood, 0.5 - kPeriod);
  EXPECT_FALSE(people.isBesideRobot(0)) << "it has gone on";
}

TEST_F(CrowdTest, IsSeenAndFelt) {
  Crowd people = crowd(7, 1);
  const Circle body = people.circles()[0];
  const double direction = directionTo(Point2{5.0, 5.0}, body.center);
  std::vector<double> ranges(1);
  people.castRays({5.0, 5.0}, direction, 0.01, 30.0, &ranges);
  EXPECT_NEAR(ranges[0], distanceBetween(Point2{5.0, 5.0}, body.center) - body.radius, 1e-9);
  people.castRays({5.0, 5.0}, direction + M_PI, 0.01, 30.0, &ranges);
  EXPECT_GT(ranges[0], 4.0) << "the wall behind";
  EXPECT_TRUE(people.touches(body.center, 0.1));
  EXPECT_TRUE(people.touches({0.0, 0.0}, 0.1)) << "the corner of the hall";
}

TEST_F(CrowdTest, IsTheSameForTheSameSeed) {
  Crowd a = crowd(9);
  Crowd b = crowd(9);
  for (int i = 0; i < 500; ++i) {
    a.advance(kPeriod, Footprint(0.01), kNowhere);
    b.advance(kPeriod, Footprint(0.01), kNowhere);
  }
  EXPECT_EQ(a.circles()[4].center.x, b.circles()[4].center.x);
  EXPECT_NE(a.circles()[4].center.x, crowd(10).circles()[4].center.x);
}

TEST_F(CrowdTest, RefusesWorldsWithoutPlace) {
  const auto refusal = [this](const std::vector<Point2>& places) {
    return test::refusalOf<std::invalid_argument>([&] { Crowd(hall, places, {}, {5.0, 5.0}, 1); });
  };
  EXPECT_EQ(refusal({}).rfind("there is no place for a walker of radius ", 0), 0u) << refusal({});
  EXPECT_EQ(refusal({{5.0, 5.0}}), "there is no place for a walker away from the robot");
}

}  // namespace
}  // namespace lstm_planner::test_crowd
