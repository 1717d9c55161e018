#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/simulation/create2.hpp"
#include "lstm_planner/simulation/scripted_driver.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_scripted_driver {
namespace {

constexpr double kPeriod = 0.05;  // s between commands
constexpr double kRadius = 0.17425;

/// 6 m x 4 m with walls around, and a wall at x = 3 m with a door 0.9 m wide at its upper end.
OccupancyGrid twoRooms() {
  OccupancyGrid grid(120, 80, 0.05);
  for (int row = 0; row < 80; ++row) {
    for (int column = 0; column < 120; ++column) {
      const bool is_border = row < 2 || column < 2 || row > 77 || column > 117;
      const bool is_wall = column >= 59 && column <= 61 && row < 60;
      if (is_border || is_wall) grid.set({column, row}, Cell::kOccupied);
    }
  }
  return grid;
}

struct Trip {
  ScriptedDriver::State state = ScriptedDriver::State::kWaiting;
  std::vector<Twist2> commands;
  std::vector<Pose2> poses;
  bool touched = false;
};

/// Drives a Create 2 until the driver has done, for `seconds` at most.
Trip drive(const GridWorld& world, const Pose2& start, double seconds, ScriptedDriver* driver) {
  Create2 robot({}, start, 1);
  Trip trip;
  double time = 0.0;
  do {
    trip.poses.push_back(robot.truePose());
    trip.commands.push_back(driver->command(robot.truePose(), time));
    robot.command(trip.commands.back());
    for (int i = 0; i < 5; ++i) robot.step(0.2 * kPeriod);
    trip.touched = trip.touched || world.touches({robot.truePose().x, robot.truePose().y}, kRadius);
    time += kPeriod;
  } while (driver->state() == ScriptedDriver::State::kDriving && time < seconds);
  trip.state = driver->state();
  return trip;
}

TEST(ScriptedDriver, DrivesThroughDoorToTheGoalWithoutTouchingAnything) {
  const GridWorld world(twoRooms());
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    ScriptedDriver driver(world, {}, seed);
    driver.setGoal({4.5, 0.8});
    const Trip trip = drive(world, {1.0, 0.8, -2.0}, 120.0, &driver);
    EXPECT_EQ(trip.state, ScriptedDriver::State::kArrived) << "seed " << seed;
    EXPECT_FALSE(trip.touched) << "seed " << seed;
    // It lets go of the keys within the arrival distance, as it foresees that.
    EXPECT_LT(distanceBetween(trip.poses.back(), Point2{4.5, 0.8}), 0.15 + 0.05) << "seed " << seed;
    EXPECT_EQ(trip.commands.back().linear, 0.0);
    EXPECT_EQ(trip.commands.back().angular, 0.0);
  }
}

TEST(ScriptedDriver, HoldsKeysThatAreDownOrUp) {
  const GridWorld world(twoRooms());
  ScriptedDriverParameters parameters;
  parameters.drives_arcs = true;
  ScriptedDriver driver(world, parameters, 1);
  driver.setGoal({4.5, 0.8});
  const Trip trip = drive(world, {1.0, 0.8, -2.0}, 120.0, &driver);
  ASSERT_EQ(trip.state, ScriptedDriver::State::kArrived);
  EXPECT_FALSE(trip.touched);
  int arcs = 0;
  for (const Twist2& command : trip.commands) {
    EXPECT_TRUE(command.linear == 0.0 || command.linear == parameters.speed);
    EXPECT_TRUE(command.angular == 0.0 || std::abs(command.angular) == parameters.turn_speed);
    arcs += command.linear != 0.0 && command.angular != 0.0 ? 1 : 0;
  }
  EXPECT_GT(arcs, 0);
}

TEST(ScriptedDriver, StopsToTurnUnlessItDrivesArcs) {
  const GridWorld world(twoRooms());
  ScriptedDriver driver(world, {}, 1);
  driver.setGoal({4.5, 0.8});
  const Trip trip = drive(world, {1.0, 0.8, -2.0}, 120.0, &driver);
  int turning = 0;
  for (const Twist2& command : trip.commands) {
    EXPECT_TRUE(command.linear == 0.0 || command.angular == 0.0);
    turning += command.angular != 0.0 ? 1 : 0;
  }
  // It looks away from the door at first, and has to turn round the wall: more than half a turn in all.
  EXPECT_GT(turning * kPeriod * ScriptedDriverParameters().turn_speed, M_PI);
}

TEST(ScriptedDriver, ReactsLate) {
  const GridWorld world(twoRooms());
  ScriptedDriverParameters parameters;
  parameters.pause_interval = 0.0;
  ScriptedDriver driver(world, parameters, 1);
  driver.setGoal({2.0, 3.0});
  const Pose2 start{1.0, 3.0, 0.0};
  double pressed = -1.0;
  for (int i = 0; i <= 40 && pressed < 0.0; ++i) {
    if (driver.command(start, 0.01 * i).linear > 0.0) pressed = 0.01 * i;
  }
  EXPECT_GE(pressed, parameters.shortest_reaction);
  EXPECT_LE(pressed, parameters.longest_reaction + 0.011);
}

TEST(ScriptedDriver, PausesWhenItIsToldTo) {
  const GridWorld world(twoRooms());
  ScriptedDriverParameters parameters;
  parameters.pause_interval = 2.0;
  ScriptedDriver pausing(world, parameters, 1);
  parameters.pause_interval = 0.0;
  ScriptedDriver hurrying(world, parameters, 1);
  const auto standing = [&](ScriptedDriver* driver) {
    driver->setGoal({4.5, 0.8});
    int count = 0;
    for (const Twist2& command : drive(world, {1.0, 0.8, 1.57}, 200.0, driver).commands) {
      count += command.linear == 0.0 && command.angular == 0.0 ? 1 : 0;
    }
    return count * kPeriod;
  };
  // Some ten pauses in 20 s of driving, of a second on average.
  EXPECT_GT(standing(&pausing), standing(&hurrying) + 3.0);
}

TEST(ScriptedDriver, DrivesAlikeForTheSameSeedOnly) {
  const GridWorld world(twoRooms());
  const auto traceOf = [&](std::uint64_t seed) {
    ScriptedDriver driver(world, {}, seed);
    driver.setGoal({4.5, 0.8});
    std::vector<double> values;
    for (const Pose2& pose : drive(world, {1.0, 0.8, 0.0}, 120.0, &driver).poses) values.push_back(pose.yaw);
    return values;
  };
  EXPECT_EQ(traceOf(1), traceOf(1));
  EXPECT_NE(traceOf(1), traceOf(2));
}

TEST(ScriptedDriver, SaysWhenThereIsNoPath) {
  OccupancyGrid grid = twoRooms();
  for (int row = 60; row < 78; ++row) grid.set({60, row}, Cell::kOccupied);
  const GridWorld closed(grid);
  for (const Point2& goal : {Point2{4.5, 0.8}, Point2{0.15, 2.0}, Point2{50.0, 50.0}}) {
    ScriptedDriver driver(closed, {}, 1);
    driver.setGoal(goal);
    const Trip trip = drive(closed, {1.0, 0.8, 0.0}, 10.0, &driver);
    EXPECT_EQ(trip.state, ScriptedDriver::State::kNoPath) << goal.x << ", " << goal.y;
    EXPECT_EQ(distanceBetween(trip.poses.front(), trip.poses.back()), 0.0);
  }
}

TEST(ScriptedDriver, FindsOutOfAPlaceThatIsNearerToAWallThanItsPaths) {
  const GridWorld world(twoRooms());
  // 2 cm between the footprint and the wall at the left, towards which it looks.
  const Pose2 start{0.1 + kRadius + 0.02, 2.0, M_PI};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    ScriptedDriver driver(world, {}, seed);
    driver.setGoal({2.0, 2.0});
    const Trip trip = drive(world, start, 60.0, &driver);
    EXPECT_EQ(trip.state, ScriptedDriver::State::kArrived) << "seed " << seed;
    EXPECT_FALSE(trip.touched) << "seed " << seed;
  }
}

TEST(ScriptedDriver, StandsWithoutGoalAndAfterItWasDropped) {
  const GridWorld world(twoRooms());
  ScriptedDriver driver(world, {}, 1);
  EXPECT_EQ(driver.state(), ScriptedDriver::State::kWaiting);
  EXPECT_EQ(driver.command({1.0, 0.8, 0.0}, 0.0).linear, 0.0);
  driver.setGoal({2.0, 0.8});
  for (int i = 1; i < 20; ++i) driver.command({1.0, 0.8, 0.0}, 0.05 * i);
  EXPECT_GT(driver.command({1.0, 0.8, 0.0}, 1.0).linear, 0.0);
  driver.dropGoal();
  EXPECT_EQ(driver.state(), ScriptedDriver::State::kWaiting);
  EXPECT_EQ(driver.command({1.0, 0.8, 0.0}, 1.05).linear, 0.0);
}

TEST(ScriptedDriver, StandsWhereThePoseIsNotKnown) {
  const GridWorld world(twoRooms());
  ScriptedDriver driver(world, {}, 1);
  driver.setGoal({2.0, 0.8});
  for (int i = 0; i < 20; ++i) driver.command({1.0, 0.8, 0.0}, 0.05 * i);
  const Twist2 command = driver.command({std::numeric_limits<double>::quiet_NaN(), 0.8, 0.0}, 1.0);
  EXPECT_EQ(command.linear, 0.0);
  EXPECT_EQ(command.angular, 0.0);
}

TEST(ScriptedDriver, DrivesOnWhenTheClockIsSetBack) {
  const GridWorld world(twoRooms());
  ScriptedDriver driver(world, {}, 1);
  driver.setGoal({2.0, 0.8});
  for (int i = 0; i < 20; ++i) driver.command({1.0, 0.8, M_PI}, 1000.0 + 0.05 * i);
  driver.setGoal({1.0, 2.8});
  EXPECT_EQ(drive(world, {1.0, 0.8, M_PI}, 60.0, &driver).state, ScriptedDriver::State::kArrived);
}

TEST(ScriptedDriver, RefusesParametersThatMakeNoSenseByName) {
  const auto messageOf = [](double ScriptedDriverParameters::*member, double value) -> std::string {
    ScriptedDriverParameters parameters;
    parameters.*member = value;
    return test::refusalOf<std::invalid_argument>([&] { validate(parameters); });
  };
  EXPECT_EQ(messageOf(&ScriptedDriverParameters::speed, -0.3),
            "parameter speed is -0.3, expected a number in [0.01, 10]");
  EXPECT_NE(messageOf(&ScriptedDriverParameters::longest_reaction, 0.1).find("longest_reaction"), std::string::npos);
  EXPECT_NE(messageOf(&ScriptedDriverParameters::wander, NAN).find("wander"), std::string::npos);
  EXPECT_EQ(messageOf(&ScriptedDriverParameters::speed, 0.2), "");
}

}  // namespace
}  // namespace lstm_planner::test_scripted_driver
