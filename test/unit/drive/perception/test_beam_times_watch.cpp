#include <gtest/gtest.h>

#include <vector>

#include "lstm_planner/drive/perception/beam_times_watch.hpp"
#include "lstm_planner/drive/perception/odometry_history.hpp"
#include "lstm_planner/simulation/simulated_robot.hpp"
#include "unit/drive/perception/room_scans.hpp"

namespace lstm_planner::test_beam_times_watch {
namespace {

constexpr double kTurn = 0.18;  // s, of an RPLIDAR A1

HokuyoParameters turningScanner(const BeamTimes& times) {
  HokuyoParameters scanner = test::turningScanner(times);
  scanner.sight = 12.0;
  scanner.noise = 0.015;
  scanner.dropout = 0.02;
  scanner.rate = 1.0 / kTurn;
  return scanner;
}

/// A robot that stands, turns to and fro, and drives a little, for 20 s; what is found then. `late`: s by which the
/// odometry's stamps are late.
std::optional<BeamTimes> foundIn(const World& world, const HokuyoParameters& scanner, double late = 0.0) {
  SimulatedRobot::Parameters parameters;
  parameters.scanner = scanner;
  SimulatedRobot robot(world, parameters, {2.0, 2.5, 0.4}, 3);
  OdometryHistory odometry(1.0);
  BeamTimesWatch watch;
  const std::vector<Twist2> commands = {{}, {0.0, 1.5}, {}, {0.0, -1.2}, {0.2, 0.5}};
  double next_scan = 0.0;
  while (robot.time() < 20.0) {
    robot.command(commands[static_cast<std::size_t>(robot.time()) % commands.size()]);
    robot.advance(0.05);
    odometry.add({robot.time() + late, robot.odometry(), robot.measuredTwist()});
    if (robot.time() < next_scan) continue;
    next_scan += 1.0 / scanner.rate;
    LaserScan scan;
    robot.scan(&scan);
    watch.show(scan, scanner.mount, Hokuyo::rules(), 1.0 / scanner.rate,
               [&](double time) { return odometry.poseAt(time); });
  }
  return watch.found();
}

GridWorld furnishedRoom() { return test::room(5.0, 4.0, {{{3.5, 0.5}, {4.2, 1.2}}, {{0.5, 3.0}, {1.5, 3.4}}}); }

TEST(BeamTimesWatch, FindsInARoomHowTheDriverListsAndStampsTheBeams) {
  for (const BeamTimes& times : {BeamTimes{0.0, 0.0}, {0.0, kTurn}, {kTurn, 0.0}, {-kTurn, 0.0}, {0.0, -kTurn}}) {
    const auto found = foundIn(furnishedRoom(), turningScanner(times));
    ASSERT_TRUE(found) << times.first << ' ' << times.last;
    EXPECT_DOUBLE_EQ(found->first, times.first);
    EXPECT_DOUBLE_EQ(found->last, times.last);
  }
}

TEST(BeamTimesWatch, SaysNothingWhereNothingIsSeen) {
  const CircleWorld field({});
  EXPECT_FALSE(foundIn(field, turningScanner({kTurn, 0.0})));
}

TEST(BeamTimesWatch, SaysNothingWhereNoRuleFits) {
  // By odometry that is stamped half a turn of the scanner late, all rules are wrong by 0.09 s or more.
  EXPECT_FALSE(foundIn(furnishedRoom(), turningScanner({kTurn, 0.0}), 0.09));
}

TEST(BeamTimesWatch, DoesNotLookWhereAScanIsTooShortForMotion) { EXPECT_FALSE(foundIn(furnishedRoom(), swept())); }

}  // namespace
}  // namespace lstm_planner::test_beam_times_watch
