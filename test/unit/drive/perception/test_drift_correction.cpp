#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "lstm_planner/drive/perception/drift_correction.hpp"
#include "support/refusal.hpp"
#include "unit/drive/perception/room_scans.hpp"

namespace lstm_planner::test_drift_correction {
namespace {

const GridWorld kRoom = test::room(8.0, 6.0, {{{3.0, 2.0}, {5.0, 4.0}}});  // a way of about 14 m around a box

/// A robot whose odometry starts at its first pose and takes each metre for `scale`, each radian for `turn_scale`.
class DriftingRobot {
 public:
  DriftingRobot(const World& world, const Pose2& start, double scale, double turn_scale)
      : scanner_(world), start_(start), pose_(start), scale_(scale), turn_scale_(turn_scale) {}

  /// Turns by that much (rad), goes on by that much (m), within that time (s); then looks.
  void move(double turn, double distance, double seconds = 1.0) {
    pose_ = moved(pose_, turn, distance);
    slip(turn, distance, seconds);
  }

  /// As move(), but only by odometry.
  void slip(double turn, double distance, double seconds = 1.0) {
    odometry_ = moved(odometry_, turn * turn_scale_, distance * scale_);
    time_ += seconds;
    Situation situation = scanner_.seenFrom(pose_, time_);
    situation.pose = odometry_;
    correction_.correct(&situation);
    believed_ = situation.pose;
  }

  /// m and rad by which it is wrong about where it is, and would be by odometry alone.
  double error() const { return distanceBetween(compose(start_, believed_), pose_); }
  double yawError() const { return std::abs(normalizeAngle(start_.yaw + believed_.yaw - pose_.yaw)); }
  double odometryError() const { return distanceBetween(compose(start_, odometry_), pose_); }
  DriftCorrection& correction() { return correction_; }

 private:
  static Pose2 moved(const Pose2& pose, double turn, double distance) {
    const Point2 at = pointAlong(pose, pose.yaw + turn, distance);
    return {at.x, at.y, normalizeAngle(pose.yaw + turn)};
  }

  test::RoomScanner scanner_;
  Pose2 start_, pose_, odometry_, believed_;
  double scale_, turn_scale_;
  double time_ = 0.0;
  DriftCorrection correction_;
};

void driveAround(DriftingRobot* robot) {
  for (const double side : {4.0, 3.6, 4.0, 3.6}) {
    for (int i = 0; i < 20; ++i) robot->move(0.0, side / 20);
    for (int i = 0; i < 4; ++i) robot->move(M_PI_2 / 4, 0.0);
  }
}

TEST(DriftCorrection, TakesTheDriftAway) {
  DriftingRobot robot(kRoom, {2.0, 1.2, 0.0}, 1.03, 0.95);
  robot.move(0.0, 0.0);
  for (int round = 0; round < 3; ++round) driveAround(&robot);
  EXPECT_GT(robot.odometryError(), 1.0);
  EXPECT_LT(robot.error(), 0.05) << "m, after 46 m";
  EXPECT_LT(robot.yawError(), 0.01);
}

TEST(DriftCorrection, AddsNextToNothingToOdometryThatIsRight) {
  DriftingRobot robot(kRoom, {2.0, 1.2, 0.0}, 1.0, 1.0);
  robot.move(0.0, 0.0);
  for (int round = 0; round < 3; ++round) driveAround(&robot);
  EXPECT_LT(robot.error(), 0.03) << "m, after 46 m";
}

TEST(DriftCorrection, TakesTheOdometrysMotionWhereNothingIsSeen) {
  const CircleWorld poles({{{15.0, 1.0}, 0.03}});
  DriftingRobot robot(poles, {}, 1.03, 1.0);
  for (int i = 0; i < 20; ++i) robot.move(0.0, 0.3);
  EXPECT_EQ(robot.error(), robot.odometryError());
}

TEST(DriftCorrection, BeginsAnewAfterAJump) {
  DriftingRobot robot(kRoom, {2.0, 1.2, 0.0}, 1.05, 1.0);
  for (int i = 0; i < 15; ++i) robot.move(0.0, 0.2);
  EXPECT_LT(robot.correction().correction().x, -0.1);
  robot.correction().restart();
  EXPECT_EQ(robot.correction().correction().x, 0.0);
  robot.move(0.0, 0.2);
  EXPECT_EQ(robot.error(), robot.odometryError()) << "there is nothing to match with";
}

/// Its first scan would otherwise be kept as taken from nowhere, and nothing be matched any more.
TEST(DriftCorrection, RefusesAPoseThatIsNotFinite) {
  DriftingRobot robot(kRoom, {2.0, 1.2, 0.0}, 1.05, 1.0);
  Situation nowhere;
  nowhere.pose.x = NAN;
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { robot.correction().correct(&nowhere); }),
            "the robot's pose in the odometry frame is (nan, 0) m with yaw 0, expected at most 1e+07 m from the origin "
            "along each axis");
  for (int i = 0; i < 15; ++i) robot.move(0.0, 0.2);
  EXPECT_LT(robot.correction().correction().x, -0.1);
}

TEST(DriftCorrection, WaitsWhileTheRobotTurnsFast) {
  DriftingRobot robot(kRoom, {2.0, 1.2, 0.0}, 1.0, 0.9);
  robot.move(0.0, 0.0);
  robot.move(0.4, 0.0, 0.4);
  EXPECT_EQ(robot.correction().correction().yaw, 0.0) << "at 1 rad/s the beams of a sweep do not fit together";
  robot.move(0.0, 0.0, 0.4);
  EXPECT_LT(robot.yawError(), 0.01) << "it stands: the turn of 0.4 rad has been matched";
}

/// m and rad; more than the robot moves from one comparison to the next.
constexpr double kCompared = 0.35;

struct InVain {
  const char* name;
  double turn;      // rad a scan
  double distance;  // m a scan
};

class DriftCorrectionInVain : public testing::TestWithParam<InVain> {};

TEST_P(DriftCorrectionInVain, TakesBackWhatThreeScansInARowDoNotShow) {
  DriftingRobot robot(kRoom, {2.0, 1.2, 0.0}, 1.0, 1.0);
  for (int i = 0; i < 3; ++i) robot.move(0.0, kCompared);
  const auto slip = [&] { robot.slip(GetParam().turn, GetParam().distance); };
  slip();
  slip();
  EXPECT_EQ(robot.correction().slip().slipped(), 0.0) << "two scans may be late, behind a fast turn";
  slip();
  const double in_vain = 3.0 * (GetParam().turn + GetParam().distance);
  EXPECT_NEAR(robot.correction().slip().slipped(), in_vain, 1e-9);
  EXPECT_LT(robot.error(), 0.02);
  EXPECT_LT(robot.yawError(), 0.01);
  slip();
  EXPECT_LT(robot.error(), 0.02);
  EXPECT_LT(robot.yawError(), 0.01);
}

INSTANTIATE_TEST_SUITE_P(DriftCorrection, DriftCorrectionInVain,
                         testing::Values(InVain{"Drives", 0.0, kCompared}, InVain{"Turns", kCompared, 0.0},
                                         InVain{"DrivesInABend", 0.2, kCompared}),
                         [](const auto& info) { return info.param.name; });

TEST(DriftCorrection, TrustsTheOdometryAgainOnceTheRobotGetsAway) {
  DriftingRobot robot(kRoom, {2.0, 1.2, 0.0}, 1.0, 1.0);
  for (int i = 0; i < 3; ++i) robot.move(0.0, kCompared);
  for (int i = 0; i < 4; ++i) robot.slip(0.0, kCompared);
  robot.move(kCompared, 0.0);
  EXPECT_GT(robot.correction().slip().slipped(), 0.0) << "it only turned, as a recovery does";
  robot.move(0.0, kCompared);
  EXPECT_EQ(robot.correction().slip().slipped(), 0.0);
  EXPECT_LT(robot.error(), 0.02);
}

TEST(DriftCorrection, LeavesItToTheOdometryHowFarTheRobotGotAlongACorridor) {
  const GridWorld corridor = test::room(90.0, 2.0);  // its ends are out of sight
  DriftingRobot robot(corridor, {45.0, 1.0, 0.0}, 1.0, 1.0);
  for (int i = 0; i < 10; ++i) robot.slip(0.0, kCompared);
  EXPECT_EQ(robot.correction().slip().slipped(), 0.0);
  EXPECT_NEAR(robot.error(), 10 * kCompared, 0.1);
}

}  // namespace
}  // namespace lstm_planner::test_drift_correction
