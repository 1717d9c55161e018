#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "lstm_planner/dataset/drive_recorder.hpp"
#include "support/refusal.hpp"
#include "unit/dataset/step_list.hpp"

namespace lstm_planner::test_drive_recorder {
namespace {

constexpr double kOdometryPeriod = 0.1;  // s
constexpr double kScanPeriod = 0.025;    // s
constexpr double kWall = 2.0;            // m, what every beam measures

std::optional<Pose2> odometryFrameOnly(const std::string& frame, double) {
  return frame == "odom" ? std::optional<Pose2>(Pose2()) : std::nullopt;
}

ScanHeard scanAt(double stamp) {
  ScanHeard heard;
  heard.stamp = stamp;
  heard.frame = "laser";
  heard.scan = {stamp, -M_PI_2, M_PI / 180.0, 0.02, 30.0, std::vector<float>(181, static_cast<float>(kWall))};
  return heard;
}

GoalHeard goalAt(double stamp, double x, double y) { return {stamp, {"odom", {x, y, 0.0}}, "test"}; }

/// What is heard of a robot that moves as it is told.
class DrivenRobot {
 public:
  explicit DrivenRobot(double start = 100.0) : time_(start) { hear(); }

  /// Seconds are given in whole milliseconds.
  void drive(double seconds, const Twist2& twist) {
    const long ticks = std::lround(seconds / kTick);
    for (long tick = 0; tick < ticks; ++tick) {
      pose_.x += kTick * twist.linear * std::cos(pose_.yaw);
      pose_.y += kTick * twist.linear * std::sin(pose_.yaw);
      pose_.yaw += kTick * twist.angular;
      twist_ = twist;
      ++ticks_;
      hear();
    }
  }

  void jump(const Pose2& pose) { pose_ = pose; }
  void wait(double seconds) { time_ += seconds; }
  /// From now on there are no scans, or there are again.
  void hide(bool hidden) { hidden_ = hidden; }
  double time() const { return time_ + static_cast<double>(ticks_) * kTick; }
  const Pose2& pose() const { return pose_; }

  std::vector<DriveEvent> events;

 private:
  static constexpr double kTick = 0.025;

  void hear() {
    if (ticks_ % std::lround(kOdometryPeriod / kTick) == 0) events.push_back(OdometryHeard{time(), pose_, twist_});
    if (!hidden_ && ticks_ % std::lround(kScanPeriod / kTick) == 0) events.push_back(scanAt(time()));
  }

  double time_;
  long ticks_ = 0;
  Pose2 pose_;
  Twist2 twist_;
  bool hidden_ = false;
};

class DriveRecorderTest : public testing::Test {
 protected:
  /// The goal at the end.
  std::optional<GoalInFrame> record(const std::vector<DriveEvent>& events) {
    DriveRecorder recorder(parameters_, &steps_, odometryFrameOnly);
    for (const DriveEvent& event : events) recorder.add(event);
    recorder.finish();
    return recorder.goal();
  }

  RecorderParameters parameters_;
  StepList steps_;
};

TEST_F(DriveRecorderTest, TakesTheRobotsMotionOutOfTheScansOfAScannerThatTurns) {
  parameters_.scan_rules.beam_times = BeamTimes{0.0, 0.1};
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(2.0, {0.3, 1.0});
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  for (DriveEvent& event : robot.events) {
    auto* const scan = std::get_if<ScanHeard>(&event);
    if (scan != nullptr) std::fill_n(scan->scan.ranges.begin() + 90, 10, kNothing);
  }
  record(robot.events);

  ASSERT_GE(steps_.episodes().at(0).steps.size(), 3u);
  const std::vector<float>& ranges = steps_.episodes()[0].steps[2].ranges;
  // Beams 90 to 99 are measured half a scan after the stamp: the robot has turned by 0.05 rad, three beams.
  EXPECT_EQ(std::count(ranges.begin(), ranges.end(), kNothing), 10);
  EXPECT_EQ(std::find(ranges.begin(), ranges.end(), kNothing) - ranges.begin(), 93);
}

TEST_F(DriveRecorderTest, MakesAStepEveryPeriodOfADrive) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(5.0, {0.3, 0.0});
  record(robot.events);

  ASSERT_EQ(steps_.episodes().size(), 1u);
  const auto& steps = steps_.episodes()[0].steps;
  // Looks at 100.0, 100.5 ... 105.0; the last one labels the one before and has no next step itself.
  ASSERT_EQ(steps.size(), 10u);
  EXPECT_EQ(steps_.rejected(Rejection::kNoNextStep), 1);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].number, static_cast<long>(i));
    EXPECT_NEAR(steps[i].stamp, 100.0 + 0.5 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(steps[i].next_stamp, steps[i].stamp + 0.5, 1e-9);
    EXPECT_NEAR(steps[i].pose.x, 0.15 * static_cast<double>(i), 1e-9);
    EXPECT_EQ(steps[i].label, 2);
    EXPECT_NEAR(steps[i].driven_angle, 0.0, 1e-9);
    EXPECT_NEAR(steps[i].observation.goal_distance, 10.0 - steps[i].pose.x, 1e-9);
    EXPECT_NEAR(steps[i].observation.sector_ranges[3], kWall, 1e-6);
    EXPECT_NEAR(steps[i].minimum_ranges[3], kWall, 1e-6);
    EXPECT_EQ(steps[i].ranges.size(), 181u);
  }
}

TEST_F(DriveRecorderTest, TellsOfAStepWhenItBegins) {
  /// The stamps of steps that have begun and, negative, of those that were labelled.
  struct Order : public StepList {
    void startStep(const DriveStep& step) override { stamps.push_back(step.stamp); }
    void addStep(const DriveStep& step) override { stamps.push_back(-step.stamp); }
    std::vector<double> stamps;
  } order;
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(1.2, {0.3, 0.0});
  DriveRecorder recorder(parameters_, &order, odometryFrameOnly);
  for (const DriveEvent& event : robot.events) recorder.add(event);
  recorder.finish();
  EXPECT_EQ(order.stamps, (std::vector<double>{100.0, -100.0, 100.5, -100.5, 101.0}));
}

TEST_F(DriveRecorderTest, TakesThePoseAtTheScansStampFromTheOdometryAroundIt) {
  DrivenRobot robot(100.04);
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(1.5, {0.4, 0.0});
  record(robot.events);
  ASSERT_GE(steps_.episodes().at(0).steps.size(), 2u);
  // The first scan at or after 100.5 is that of 100.515, between the odometry of 100.44 and of 100.54.
  const DriveStep& step = steps_.episodes()[0].steps[1];
  EXPECT_NEAR(step.stamp, 100.515, 1e-9);
  EXPECT_NEAR(step.pose.x, 0.4 * (100.515 - 100.04), 1e-9);
}

TEST_F(DriveRecorderTest, LabelsAStepWithTheAngleThatWasDrivenToTheNext) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 10.0));
  robot.drive(0.5, {0.3, 0.0});
  // Half a second in place is less than min_step_turn: the robot has not moved until it drives on.
  robot.drive(0.5, {0.0, M_PI_2});
  robot.drive(0.5, {0.3, 0.0});
  robot.drive(0.5, {0.3, 0.0});
  parameters_.min_step_turn = 0.0;
  record(robot.events);
  const auto& steps = steps_.episodes().at(0).steps;
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[0].label, 2);
  // Where the turn started, the path on lay 45 degrees to the left.
  EXPECT_NEAR(steps[1].driven_angle, M_PI_4, 1e-9);
  EXPECT_EQ(steps[1].label, 3);
  EXPECT_NEAR(steps[1].next_stamp - steps[1].stamp, 1.0, 1e-9);
  EXPECT_EQ(steps[2].label, 2);
  EXPECT_NEAR(steps[2].observation.previous_action, M_PI_4, 1e-6);
  EXPECT_NEAR(steps[2].observation.heading, M_PI_4, 1e-9);
}

TEST_F(DriveRecorderTest, ATurnInPlaceIsAStepOfItsOwnWhenThatIsWanted) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 10.0));
  robot.drive(1.0, {0.0, -M_PI_2});
  robot.drive(1.0, {0.3, 0.0});
  parameters_.min_step_turn = M_PI_4 - 0.01;
  record(robot.events);
  const auto& steps = steps_.episodes().at(0).steps;
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_NEAR(steps[0].driven_angle, -M_PI_4, 1e-9);
  EXPECT_EQ(steps[0].label, 1);
  EXPECT_EQ(steps[1].label, 1);
  EXPECT_EQ(steps[2].label, 2);
}

TEST_F(DriveRecorderTest, StandingMakesNoSteps) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(3.0, {0.0, 0.0});
  record(robot.events);
  ASSERT_EQ(steps_.episodes().size(), 1u);
  EXPECT_TRUE(steps_.episodes()[0].steps.empty());
  EXPECT_EQ(steps_.rejected(Rejection::kStanding), 6);
}

TEST_F(DriveRecorderTest, DrivingBackwardsHasNoLabel) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(2.0, {-0.3, 0.0});
  robot.drive(1.0, {0.3, 0.0});
  record(robot.events);
  EXPECT_EQ(steps_.rejected(Rejection::kNoAllowedAngle), 4);
  // What follows keeps its number: a sequence is not continued across the gap.
  ASSERT_EQ(steps_.episodes().at(0).steps.size(), 2u);
  EXPECT_EQ(steps_.episodes()[0].steps[0].number, 4);
}

TEST_F(DriveRecorderTest, ArrivalEndsTheEpisodeAndTheGoal) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 1.0, 0.0));
  robot.drive(5.0, {0.3, 0.0});
  record(robot.events);
  ASSERT_EQ(steps_.episodes().size(), 1u);
  EXPECT_EQ(steps_.episodes()[0].episode.end, EpisodeEnd::kArrived);
  // 0.7 m at 0.3 m/s, and the next odometry.
  EXPECT_NEAR(steps_.episodes()[0].episode.ended, 102.4, 1e-9);
  EXPECT_GT(steps_.rejected(Rejection::kNoGoal), 0);
}

TEST_F(DriveRecorderTest, AnotherGoalBeginsAnotherEpisodeAndTheSameOneDoesNot) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(1.0, {0.3, 0.0});
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(1.0, {0.3, 0.0});
  robot.events.push_back(goalAt(robot.time(), 10.0, 5.0));
  robot.drive(1.0, {0.3, 0.0});
  record(robot.events);
  ASSERT_EQ(steps_.episodes().size(), 2u);
  EXPECT_EQ(steps_.episodes()[0].episode.end, EpisodeEnd::kNewGoal);
  EXPECT_EQ(steps_.episodes()[1].episode.end, EpisodeEnd::kFinished);
  EXPECT_EQ(steps_.episodes()[1].steps.front().number, 0);
  EXPECT_EQ(steps_.episodes()[1].steps.front().observation.previous_action, 0.0);
}

TEST_F(DriveRecorderTest, AGoalThatIsGivenUpEndsTheEpisode) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(1.0, {0.3, 0.0});
  robot.events.push_back(GoalGivenUp{robot.time()});
  robot.drive(1.0, {0.3, 0.0});
  record(robot.events);
  ASSERT_EQ(steps_.episodes().size(), 1u);
  EXPECT_EQ(steps_.episodes()[0].episode.end, EpisodeEnd::kAborted);
}

TEST_F(DriveRecorderTest, AJumpOfTheOdometryEndsTheEpisodeAndTheGoalInItsFrame) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 20.0, 0.0));
  robot.drive(2.0, {0.3, 0.0});
  robot.jump({5.0, 5.0, 1.0});
  robot.drive(2.0, {0.3, 0.0});
  record(robot.events);
  ASSERT_EQ(steps_.episodes().size(), 1u);
  EXPECT_EQ(steps_.episodes()[0].episode.end, EpisodeEnd::kOdometryJump);
  EXPECT_GT(steps_.rejected(Rejection::kNoGoal), 0);
}

TEST_F(DriveRecorderTest, AGoalInAnotherFrameStaysTheGoalWhenTheOdometryJumps) {
  DrivenRobot robot;
  robot.events.push_back(GoalHeard{robot.time(), {"map", {20.0, 0.0, 0.0}}, "test"});
  robot.drive(2.0, {0.3, 0.0});
  robot.jump({5.0, 5.0, 1.0});
  robot.drive(2.0, {0.3, 0.0});
  DriveRecorder recorder(parameters_, &steps_, [](const std::string&, double) { return Pose2{1.0, 0.0, 0.0}; });
  for (const DriveEvent& event : robot.events) recorder.add(event);
  recorder.finish();
  ASSERT_EQ(steps_.episodes().size(), 2u);
  EXPECT_EQ(steps_.episodes()[0].episode.end, EpisodeEnd::kOdometryJump);
  for (const auto& episode : steps_.episodes()) {
    for (const DriveStep& step : episode.steps) EXPECT_LT(distanceBetween(step.pose, step.next_pose), 0.2);
  }
}

TEST_F(DriveRecorderTest, AJumpOfTheClockEndsTheEpisodeInEitherDirection) {
  for (const double jump : {-50.0, 30.0}) {
    steps_ = {};
    DrivenRobot robot;
    robot.events.push_back(goalAt(robot.time(), 20.0, 0.0));
    robot.drive(2.0, {0.3, 0.0});
    robot.wait(jump);
    robot.drive(2.0, {0.3, 0.0});
    record(robot.events);
    ASSERT_EQ(steps_.episodes().size(), 2u) << jump;
    EXPECT_EQ(steps_.episodes()[0].episode.end, EpisodeEnd::kTimeJump) << jump;
    EXPECT_EQ(steps_.episodes()[0].steps.size(), 4u) << jump;
    // Looks at the first odometry after the jump, 0.1 s later, and at four half seconds of the new time.
    EXPECT_EQ(steps_.episodes()[1].steps.size(), 4u) << jump;
  }
}

TEST_F(DriveRecorderTest, AClockSetBackEndsAGoalInOdometryOnlyWhereTheOdometryJumpsToo) {
  for (const bool jumps : {false, true}) {
    DrivenRobot robot;
    robot.events.push_back(goalAt(robot.time(), 20.0, 0.0));
    robot.drive(2.0, {0.3, 0.0});
    robot.wait(-100.0);
    if (jumps) robot.jump({5.0, 5.0, 0.0});
    robot.drive(2.0, {0.3, 0.0});
    EXPECT_EQ(record(robot.events).has_value(), !jumps);
  }
}

TEST_F(DriveRecorderTest, AGoalThatComesBeforeTheFirstOdometryOfTheNextDriveIsThatDrives) {
  for (const double wait : {-100.0, 100.0}) {
    steps_ = {};
    DrivenRobot robot;
    robot.events.push_back(goalAt(robot.time(), 20.0, 0.0));
    robot.drive(2.0, {0.3, 0.0});
    robot.wait(wait);
    robot.jump({5.0, 5.0, 0.0});
    robot.events.push_back(goalAt(robot.time(), 20.0, 0.0));
    robot.drive(2.0, {0.3, 0.0});
    EXPECT_TRUE(record(robot.events).has_value()) << wait;
    EXPECT_EQ(steps_.episodes().size(), 2u) << wait;
  }
}

TEST_F(DriveRecorderTest, AGoalFromAComputerWithAnotherClockIsTakenNow) {
  DrivenRobot robot;
  robot.drive(1.0, {0.3, 0.0});
  robot.events.push_back(goalAt(5.0e6, 10.0, 0.0));
  robot.drive(2.0, {0.3, 0.0});
  record(robot.events);
  ASSERT_EQ(steps_.episodes().size(), 1u);
  EXPECT_EQ(steps_.episodes()[0].episode.end, EpisodeEnd::kFinished);
  EXPECT_EQ(steps_.episodes()[0].steps.size(), 4u);
}

TEST_F(DriveRecorderTest, PausingEndsTheEpisodeAndTheGoalStays) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(6.0, {0.3, 0.0});
  DriveRecorder recorder(parameters_, &steps_, odometryFrameOnly);
  for (const DriveEvent& event : robot.events) {
    recorder.setPaused(stampOf(event) > 102.3 && stampOf(event) < 104.3);
    recorder.add(event);
  }
  recorder.finish();
  ASSERT_EQ(steps_.episodes().size(), 2u);
  EXPECT_EQ(steps_.episodes()[0].episode.end, EpisodeEnd::kPaused);
  EXPECT_GT(steps_.rejected(Rejection::kPaused), 2);
}

TEST_F(DriveRecorderTest, ScansWithoutOdometryAroundThemAreCounted) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(4.0, {0.3, 0.0});
  std::vector<DriveEvent> events;
  for (const DriveEvent& event : robot.events) {
    const bool is_odometry = std::holds_alternative<OdometryHeard>(event);
    if (!is_odometry || stampOf(event) < 101.05 || stampOf(event) > 102.05) events.push_back(event);
  }
  record(events);
  // From 101.0, when odometry was last heard, to 102.1.
  EXPECT_EQ(steps_.rejected(Rejection::kNoOdometry), 43);
  EXPECT_EQ(steps_.reason(Rejection::kNoOdometry),
            "from one odometry message to the next it takes 1.100 s, expected at most 0.5 s");
  EXPECT_EQ(steps_.episodes().at(0).steps.size(), 7u);
}

TEST_F(DriveRecorderTest, ScansThatOdometryDoesNotReachAreCountedWithTheReason) {
  DrivenRobot robot;
  robot.events.push_back(scanAt(robot.time() - 0.01));
  robot.drive(1.0, {0.3, 0.0});
  record(robot.events);
  EXPECT_EQ(steps_.reason(Rejection::kNoOdometry), "the scan is older than the first odometry");

  steps_ = {};
  robot.jump({5.0, 5.0, 1.0});
  robot.drive(1.0, {0.3, 0.0});
  record(robot.events);
  EXPECT_EQ(steps_.reason(Rejection::kNoOdometry),
            "the odometry jumps from one message to the next, and the scan lies between them");

  steps_ = {};
  robot = DrivenRobot();
  robot.drive(1.0, {0.3, 0.0});
  for (int i = 1; i <= 201; ++i) robot.events.push_back(scanAt(robot.time() + 0.001 * i));
  record(robot.events);
  EXPECT_EQ(steps_.rejected(Rejection::kNoOdometry), 1);
  EXPECT_EQ(steps_.reason(Rejection::kNoOdometry), "200 scans already wait for the next odometry message");
}

TEST_F(DriveRecorderTest, ScansOfAnotherClockThanTheOdometrysAreCountedWithTheReason) {
  for (const double difference : {50.0, -50.0}) {
    steps_ = {};
    DrivenRobot robot;
    robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
    robot.drive(1.0, {0.3, 0.0});
    long scans = 0;
    for (DriveEvent& event : robot.events) {
      if (auto* scan = std::get_if<ScanHeard>(&event)) {
        scan->stamp += difference;
        ++scans;
      }
    }
    record(robot.events);
    EXPECT_TRUE(steps_.episodes().empty());
    EXPECT_EQ(steps_.rejected(Rejection::kNoOdometry), scans - 1);  // the last one still waits
    EXPECT_NE(steps_.reason(Rejection::kNoOdometry).find("different clocks"), std::string::npos);
  }
}

TEST_F(DriveRecorderTest, LateMessagesAreCountedWithTheirDelay) {
  DrivenRobot robot;
  robot.drive(1.0, {0.3, 0.0});
  robot.events.push_back(scanAt(robot.time() - 0.5));
  record(robot.events);
  EXPECT_EQ(steps_.rejected(Rejection::kLate), 1);
  EXPECT_EQ(steps_.reason(Rejection::kLate),
            "a message comes 0.500 s after others with later stamps, expected at most delay = 0.3 s");
}

TEST_F(DriveRecorderTest, AGoalAndItsEndHoldHoweverLateTheyCome) {
  for (const double age : {0.2, 0.5, 1.5, 2.5}) {
    steps_ = {};
    DrivenRobot robot;
    robot.drive(4.0, {0.3, 0.0});
    robot.events.push_back(goalAt(robot.time() - age, 10.0, 0.0));
    robot.drive(4.0, {0.3, 0.0});
    robot.events.push_back(GoalGivenUp{robot.time() - age});
    robot.drive(4.0, {0.3, 0.0});
    record(robot.events);
    EXPECT_EQ(steps_.rejected(Rejection::kLate), 0) << age;
    ASSERT_EQ(steps_.episodes().size(), 1u) << age;
    const Episode& episode = steps_.episodes()[0].episode;
    EXPECT_EQ(episode.end, EpisodeEnd::kAborted) << age;
    EXPECT_NEAR(episode.ended - episode.begun, 4.0, 0.6) << age;
  }
}

TEST_F(DriveRecorderTest, ScansThatCannotBeAveragedAreCountedAndTheNextIsTaken) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(2.0, {0.3, 0.0});
  for (DriveEvent& event : robot.events) {
    auto* scan = std::get_if<ScanHeard>(&event);
    if (scan != nullptr && std::abs(scan->stamp - 101.0) < 1e-6) scan->scan.ranges.resize(90);
  }
  record(robot.events);
  EXPECT_EQ(steps_.rejected(Rejection::kUnusableScan), 1);
  ASSERT_EQ(steps_.episodes().at(0).steps.size(), 4u);
  EXPECT_NEAR(steps_.episodes()[0].steps[2].stamp, 101.025, 1e-9);
}

TEST_F(DriveRecorderTest, NothingIsRecordedWhileTheScannerIsCovered) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
  robot.drive(3.0, {0.3, 0.0});
  for (DriveEvent& event : robot.events) {
    auto* scan = std::get_if<ScanHeard>(&event);
    const bool covered = scan != nullptr && scan->stamp > 101.2 && scan->stamp < 102.2;
    if (covered) std::fill(scan->scan.ranges.begin(), scan->scan.ranges.end(), std::nanf(""));
  }
  parameters_.scan_rules = urgNodeRules();
  record(robot.events);
  EXPECT_EQ(steps_.rejected(Rejection::kUnusableScan), 2) << "once a look, at 101.5 and 102.0, however many scans";
  for (const DriveStep& step : steps_.episodes().at(0).steps) {
    EXPECT_TRUE(step.stamp < 101.2 || step.stamp > 102.2 - 1e-6) << step.stamp;
  }
}

TEST_F(DriveRecorderTest, ARobotThatIsPutIntoAnOpenFieldIsRecordedThere) {
  DrivenRobot robot;
  robot.drive(1.0, {0.3, 0.0});
  robot.jump({50.0, 0.0, 0.0});
  robot.events.push_back(goalAt(robot.time() + 0.5, 60.0, 0.0));
  robot.drive(2.0, {0.3, 0.0});
  for (DriveEvent& event : robot.events) {
    auto* scan = std::get_if<ScanHeard>(&event);
    if (scan != nullptr && scan->stamp > 101.0) {
      std::fill(scan->scan.ranges.begin(), scan->scan.ranges.end(), std::nanf(""));
    }
  }
  parameters_.scan_rules = urgNodeRules();
  record(robot.events);
  EXPECT_EQ(steps_.rejected(Rejection::kUnusableScan), 0);
  ASSERT_EQ(steps_.episodes().size(), 1u);
  EXPECT_GE(steps_.episodes()[0].steps.size(), 2u);
}

TEST_F(DriveRecorderTest, ScansThatAreMissingForLongEndTheEpisode) {
  for (const double silence : {1.8, 5.0}) {
    steps_ = {};
    DrivenRobot robot;
    robot.events.push_back(goalAt(robot.time(), 10.0, 0.0));
    robot.drive(2.0, {0.3, 0.0});
    robot.hide(true);
    robot.drive(silence, {0.3, 0.0});
    robot.hide(false);
    robot.drive(2.0, {0.3, 0.0});
    record(robot.events);
    const bool is_long = silence > parameters_.max_gap;
    ASSERT_EQ(steps_.episodes().size(), is_long ? 2u : 1u) << silence;
    EXPECT_EQ(steps_.episodes()[0].episode.end, is_long ? EpisodeEnd::kTimeJump : EpisodeEnd::kFinished) << silence;
    for (const auto& recorded : steps_.episodes()) {
      for (const DriveStep& step : recorded.steps) EXPECT_LE(step.next_stamp - step.stamp, parameters_.max_gap + 0.5);
    }
  }
}

TEST_F(DriveRecorderTest, AGoalInAFrameThatIsNotKnownIsCounted) {
  DrivenRobot robot;
  robot.events.push_back(GoalHeard{robot.time(), {"map", {10.0, 0.0, 0.0}}, "test"});
  robot.drive(1.0, {0.3, 0.0});
  record(robot.events);
  EXPECT_TRUE(steps_.episodes().empty());
  EXPECT_EQ(steps_.rejected(Rejection::kNoTransform), 3);
  EXPECT_EQ(steps_.reason(Rejection::kNoTransform),
            "no transform leads from the goal's frame 'map' to that of the odometry");
}

TEST_F(DriveRecorderTest, TheOrderOfArrivalDoesNotMatter) {
  DrivenRobot robot;
  robot.events.push_back(goalAt(robot.time() + 0.2, 3.0, 1.0));
  robot.drive(3.0, {0.3, 0.2});
  robot.drive(2.0, {0.2, -0.9});
  robot.drive(3.0, {0.3, 0.4});
  record(robot.events);
  const StepList in_order = steps_;
  ASSERT_GT(in_order.episodes().at(0).steps.size(), 10u);

  std::mt19937 random(1);
  std::vector<std::pair<double, std::size_t>> arrivals;
  for (std::size_t i = 0; i < robot.events.size(); ++i) {
    const double delay = 0.29 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    arrivals.emplace_back(stampOf(robot.events[i]) + delay, i);
  }
  std::sort(arrivals.begin(), arrivals.end());
  std::vector<DriveEvent> shuffled;
  for (const auto& arrival : arrivals) shuffled.push_back(robot.events[arrival.second]);
  steps_ = {};
  record(shuffled);

  ASSERT_EQ(steps_.episodes().size(), in_order.episodes().size());
  EXPECT_EQ(steps_.rejections(), in_order.rejections());
  const auto& expected = in_order.episodes()[0].steps;
  ASSERT_EQ(steps_.episodes()[0].steps.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(steps_.episodes()[0].steps[i].stamp, expected[i].stamp);
    EXPECT_EQ(steps_.episodes()[0].steps[i].pose.x, expected[i].pose.x);
    EXPECT_EQ(steps_.episodes()[0].steps[i].label, expected[i].label);
  }
}

TEST_F(DriveRecorderTest, NumbersThatAreNotFiniteAreCounted) {
  DrivenRobot robot;
  robot.events.push_back(OdometryHeard{std::numeric_limits<double>::quiet_NaN(), {}, {}});
  record(robot.events);
  EXPECT_EQ(steps_.rejected(Rejection::kNotFinite), 1);
}

TEST_F(DriveRecorderTest, WhatNobodyMeasuresIsCountedAndMakesNoSteps) {
  DrivenRobot robot;
  robot.drive(3.0, {0.3, 0.0});
  const std::vector<DriveEvent>& events = robot.events;
  const auto with = [&](const DriveEvent& event) {
    steps_ = StepList();
    std::vector<DriveEvent> heard = events;
    heard.insert(heard.begin() + 3, event);
    record(heard);
    EXPECT_GT(steps_.rejected(Rejection::kNoGoal), 0) << "the drive itself has no goal, and that goal is none";
    EXPECT_TRUE(steps_.episodes().empty());
    return steps_.rejected(Rejection::kNotFinite);
  };
  const double stamp = stampOf(events[2]);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(with(GoalHeard{stamp, {"odom", {1.7e308, 0.0, 0.0}}, "test"}), 1);
  EXPECT_EQ(with(GoalHeard{stamp, {"odom", {0.0, -infinity, 0.0}}, "test"}), 1);
  EXPECT_EQ(with(GoalHeard{stamp, {std::string(2000, 'o'), {}}, "test"}), 1);
  EXPECT_EQ(with(OdometryHeard{stamp, {0.0, 1e300, 0.0}, {}}), 1);
  EXPECT_EQ(with(OdometryHeard{stamp, {}, {std::nan(""), 0.0}}), 1);
  EXPECT_EQ(with(GoalGivenUp{1e300}), 1);
  ScanHeard scan{stamp, {}, {}, "laser"};
  scan.scan.ranges.resize(static_cast<std::size_t>(kMostBeams) + 1);
  EXPECT_EQ(with(scan), 1);
}

TEST_F(DriveRecorderTest, PosesAndGoalsOutOfReachAreCountedAndMakeNoStep) {
  DrivenRobot robot;
  robot.events.push_back(OdometryHeard{robot.time(), {1e9, 0.0, 0.0}, {}});
  robot.events.push_back(goalAt(robot.time(), 1e6, 0.0));
  robot.drive(2.0, {0.3, 0.0});
  record(robot.events);
  EXPECT_GE(steps_.rejected(Rejection::kNotFinite), 3);
  EXPECT_TRUE(steps_.episodes().empty());
}

TEST(RecorderParameters, ComeBackFromJson) {
  RecorderParameters parameters;
  parameters.period = 0.25;
  parameters.keep_scans = false;
  parameters.action_angles = {-1.0, 0.0, 1.0};
  parameters.agent.shield.footprint_radius = 0.3;
  const RecorderParameters read = recorderParametersFromJson(toJson(parameters));
  EXPECT_EQ(read.period, 0.25);
  EXPECT_FALSE(read.keep_scans);
  EXPECT_EQ(read.action_angles, parameters.action_angles);
  EXPECT_EQ(read.agent.shield.footprint_radius, 0.3);
  EXPECT_EQ(toJson(read), toJson(parameters));
}

TEST(RecorderParameters, AreRefusedWithTheirNameAndValue) {
  RecorderParameters parameters;
  parameters.max_gap = 0.4;
  const std::string sentence = test::refusalOf<std::invalid_argument>([&] { validate(parameters); });
  EXPECT_NE(sentence.find("max_gap is 0.4, expected more than period"), std::string::npos) << sentence;
}

TEST(DrivenAngle, IsTheDirectionToTheNextPoseRelativeToTheHeading) {
  EXPECT_NEAR(drivenAngle({0, 0, M_PI_2}, {0, 1, 0}, 0.05), 0.0, 1e-12);
  EXPECT_NEAR(drivenAngle({0, 0, M_PI_2}, {1, 0, 0}, 0.05), -M_PI_2, 1e-12);
  EXPECT_NEAR(drivenAngle({1, 1, 3.0}, {0, 1, 3.0}, 0.05), M_PI - 3.0, 1e-12);
}

TEST(DrivenAngle, IsTheTurnOfARobotThatStayedWhereItWas) {
  EXPECT_NEAR(drivenAngle({0, 0, 3.0}, {0.01, 0, -3.0}, 0.05), 2.0 * M_PI - 6.0, 1e-12);
}

}  // namespace
}  // namespace lstm_planner::test_drive_recorder
