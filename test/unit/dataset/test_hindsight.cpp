#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/dataset/hindsight.hpp"
#include "support/refusal.hpp"
#include "unit/dataset/step_list.hpp"

namespace lstm_planner::test_hindsight {
namespace {

/// Odometry of a robot at 10 Hz.
class Path {
 public:
  Path() { hear(); }

  Path& drive(double distance, double speed = 0.5) {
    const int count = static_cast<int>(std::lround(distance / speed / kPeriod));
    for (int i = 0; i < count; ++i) {
      const Point2 there = pointAlong(pose_, pose_.yaw, distance / count);
      pose_ = {there.x, there.y, pose_.yaw};
      hear(kPeriod);
    }
    return *this;
  }

  Path& turn(double angle, double seconds) {
    const int count = static_cast<int>(std::lround(seconds / kPeriod));
    for (int i = 0; i < count; ++i) {
      pose_.yaw += angle / count;
      hear(kPeriod);
    }
    return *this;
  }

  Path& stand(double seconds) { return turn(0.0, seconds); }

  /// A circle to the left.
  Path& circle(double radius) {
    constexpr int kCount = 120;
    for (int i = 0; i < kCount; ++i) {
      pose_.yaw += 2.0 * M_PI / kCount;
      const Point2 there = pointAlong(pose_, pose_.yaw - M_PI / kCount, 2.0 * radius * std::sin(M_PI / kCount));
      pose_ = {there.x, there.y, pose_.yaw};
      hear(kPeriod);
    }
    return *this;
  }

  Path& jump(double x, double y) {
    pose_.x = x;
    pose_.y = y;
    hear(kPeriod);
    return *this;
  }

  Path& silence(double seconds) {
    stamp_ += seconds;
    hear();
    return *this;
  }

  double now() const { return stamp_; }
  const std::vector<OdometryHeard>& odometry() const { return odometry_; }

 private:
  static constexpr double kPeriod = 0.1;  // s

  void hear(double elapsed = 0.0) {
    stamp_ += elapsed;
    odometry_.push_back({stamp_, pose_, {}});
  }

  Pose2 pose_;
  double stamp_ = 100.0;
  std::vector<OdometryHeard> odometry_;
};

struct Goal {
  double from = 0.0;  ///< s
  double until = 0.0;
  Pose2 pose;
};

std::vector<Goal> goalsOf(const Path& path, const HindsightParameters& parameters = {},
                          const RecorderParameters& recorder = {}) {
  std::vector<Goal> goals;
  for (const DriveEvent& event : hindsightGoals(path.odometry(), parameters, recorder, "odom")) {
    if (const auto* heard = std::get_if<GoalHeard>(&event)) {
      EXPECT_EQ(heard->goal.frame, "odom");
      EXPECT_EQ(heard->source, "hindsight");
      goals.push_back({heard->stamp, 0.0, heard->goal.pose});
    } else {
      goals.back().until = std::get<GoalGivenUp>(event).stamp;
    }
  }
  return goals;
}

TEST(HindsightTest, PlacesWhereTheRobotStoodAreGoalsFromWhenItLeftTheLast) {
  Path path;
  path.stand(5.0).drive(4.0).stand(3.0);
  const double first_left = path.now();
  path.turn(M_PI_2, 1.0).drive(3.0).stand(2.5);

  const std::vector<Goal> goals = goalsOf(path);
  ASSERT_EQ(goals.size(), 2u);
  EXPECT_NEAR(goals[0].pose.x, 4.0, 1e-9);
  EXPECT_NEAR(goals[0].from, 105.0, 1e-6);  // it stood at the start for 5 s
  EXPECT_NEAR(goals[0].until, goals[1].from, 1e-6);
  EXPECT_NEAR(goals[1].pose.y, 3.0, 1e-9);
  EXPECT_NEAR(goals[1].pose.yaw, M_PI_2, 1e-9);
  // It turns by 90 degrees in a second: it has moved when it has turned by min_step_turn, half of that.
  EXPECT_GE(goals[1].from, first_left);
  EXPECT_LE(goals[1].from, first_left + 0.5);
}

TEST(HindsightTest, ShorterPausesAreNoGoals) {
  Path path;
  path.drive(4.0).stand(1.5).drive(4.0);
  const std::vector<Goal> goals = goalsOf(path);
  ASSERT_EQ(goals.size(), 1u);
  EXPECT_NEAR(goals[0].pose.x, 8.0, 1e-9);
}

TEST(HindsightTest, NearPlacesAreOnThePathToTheNext) {
  Path path;
  path.drive(1.0).stand(3.0).drive(5.0);
  const std::vector<Goal> goals = goalsOf(path);
  ASSERT_EQ(goals.size(), 1u);
  EXPECT_NEAR(goals[0].pose.x, 6.0, 1e-9);
  EXPECT_DOUBLE_EQ(goals[0].from, 100.0);
}

TEST(HindsightTest, LongPathsAreDividedIntoEqualParts) {
  Path path;
  path.drive(24.0);
  const std::vector<Goal> goals = goalsOf(path);
  ASSERT_EQ(goals.size(), 3u);  // 24 m in parts of at most 10 m
  for (std::size_t i = 0; i < goals.size(); ++i) {
    EXPECT_NEAR(goals[i].pose.x, 8.0 * static_cast<double>(i + 1), 0.05 + 1e-9);  // one message is 0.05 m
    EXPECT_DOUBLE_EQ(goals[i].from, i == 0 ? 100.0 : goals[i - 1].until);
  }
}

TEST(HindsightTest, JumpsAndGapsEndPaths) {
  Path path;
  path.drive(3.0).jump(20.0, 0.0).drive(4.0).silence(2.5).drive(5.0);
  const std::vector<Goal> goals = goalsOf(path);
  ASSERT_EQ(goals.size(), 3u);
  EXPECT_NEAR(goals[0].pose.x, 3.0, 1e-9);
  EXPECT_NEAR(goals[1].pose.x, 24.0, 1e-9);
  EXPECT_NEAR(goals[2].pose.x, 29.0, 1e-9);
  EXPECT_GT(goals[1].from, goals[0].until);
}

TEST(HindsightTest, WhoReturnsFromADeadEndHasDrivenToItsEndFirst) {
  Path path;
  path.drive(4.5).turn(M_PI, 1.5).drive(4.5).stand(3.0);
  const std::vector<Goal> goals = goalsOf(path);
  const double tolerance = RecorderParameters().goal_tolerance;
  ASSERT_EQ(goals.size(), 2u);
  // On the way back all is near to where it was before, but for what is within the tolerance of the turning point.
  EXPECT_NEAR(goals[0].pose.x, 4.5 - tolerance, 0.05 + 1e-9);
  EXPECT_NEAR(goals[1].pose.x, 0.0, 1e-9);
}

TEST(HindsightTest, ALoopEndsBeforeItComesBackToItsStart) {
  Path path;
  path.circle(1.2).stand(3.0);  // 7.5 m
  const std::vector<Goal> goals = goalsOf(path);
  const double tolerance = RecorderParameters().goal_tolerance;
  ASSERT_EQ(goals.size(), 1u);
  const double to_start = distanceBetween(goals[0].pose, Pose2());
  EXPECT_GT(to_start, tolerance);
  EXPECT_LT(to_start, tolerance + 2.0 * M_PI * 1.2 / 120.0);  // at most one message before
}

TEST(HindsightTest, CirclesOnTheSpotHaveNoGoal) {
  Path path;
  for (int i = 0; i < 10; ++i) path.circle(0.2);
  EXPECT_TRUE(goalsOf(path).empty());
}

TEST(HindsightTest, AFloodOfMessagesWhoseStampsHardlyGoOnChangesNothing) {
  std::vector<OdometryHeard> path = Path().drive(5.0).stand(3.0).odometry();
  const std::vector<DriveEvent> goals = hindsightGoals(path, {}, {}, "odom");
  ASSERT_FALSE(goals.empty());
  constexpr double kLasts = 2e-4;  // s
  std::vector<OdometryHeard> flood(200000, path.front());
  for (std::size_t i = 0; i < flood.size(); ++i) {
    flood[i].stamp -= kLasts * (1.0 - static_cast<double>(i) / static_cast<double>(flood.size()));
  }
  path.insert(path.begin(), flood.begin(), flood.end());
  const std::vector<DriveEvent> again = hindsightGoals(path, {}, {}, "odom");
  ASSERT_EQ(again.size(), goals.size());
  for (std::size_t i = 0; i < goals.size(); ++i) EXPECT_NEAR(stampOf(again[i]), stampOf(goals[i]), 2.0 * kLasts);
}

TEST(HindsightTest, NothingOfNothing) {
  EXPECT_TRUE(hindsightGoals({}, {}, {}, "odom").empty());
  EXPECT_TRUE(goalsOf(Path()).empty());
  EXPECT_TRUE(goalsOf(Path().stand(60.0)).empty());
}

/// A drive with everything that makes goals hard to find.
Path crookedPath() {
  Path path;
  path.drive(7.0).turn(2.5, 1.0).drive(6.0, 0.3).circle(1.5).circle(1.5).drive(3.0).stand(4.0);
  path.turn(M_PI, 3.0).drive(9.0).turn(-1.0, 0.5).drive(13.0, 0.8).circle(0.25).drive(2.5).silence(4.0).drive(3.0);
  return path;
}

TEST(HindsightTest, NoPathPassesItsGoalBeforeItsEnd) {
  const Path path = crookedPath();
  const RecorderParameters recorder;
  const std::vector<Goal> goals = goalsOf(path);
  EXPECT_GT(goals.size(), 5u);  // some 60 m in parts of at most 10 m
  for (const Goal& goal : goals) {
    bool is_near = false;
    double driven = 0.0;
    const OdometryHeard* before = nullptr;
    for (const OdometryHeard& heard : path.odometry()) {
      if (heard.stamp < goal.from || heard.stamp > goal.until) continue;
      if (before != nullptr) driven += distanceBetween(before->pose, heard.pose);
      before = &heard;
      const bool was_near = is_near;
      is_near = distanceBetween(heard.pose, goal.pose) <= recorder.goal_tolerance;
      EXPECT_TRUE(is_near || !was_near) << "left again at " << heard.stamp;
    }
    EXPECT_TRUE(is_near);
    EXPECT_GE(driven, HindsightParameters().shortest);
    EXPECT_LE(driven, HindsightParameters().longest + 0.1);
  }
}

/// What the recorder makes of a path and its goals in hindsight, with a scan after every odometry message.
StepList recorded(const std::vector<OdometryHeard>& path) {
  const RecorderParameters parameters;
  StepList steps;
  DriveRecorder recorder(parameters, &steps, [](const std::string&, double) { return Pose2(); });
  GoalSchedule goals(hindsightGoals(path, {}, parameters, "odom"), parameters.max_gap);
  for (const OdometryHeard& heard : path) {
    recorder.add(heard);
    goals.tell(heard.stamp, &recorder);
    ScanHeard scan;
    scan.stamp = heard.stamp + 0.01;
    scan.scan = {scan.stamp, -M_PI_2, M_PI / 180.0, 0.02, 30.0, std::vector<float>(181, 2.0f)};
    recorder.add(scan);
  }
  recorder.finish();
  return steps;
}

TEST(HindsightTest, EveryEpisodeOfARecordedPathArrives) {
  const Path path = crookedPath();
  const StepList steps = recorded(path.odometry());
  EXPECT_EQ(steps.episodes().size(), goalsOf(path).size());
  for (const RecordedEpisode& episode : steps.episodes()) {
    EXPECT_EQ(episode.episode.end, EpisodeEnd::kArrived);
    EXPECT_EQ(episode.episode.goal_source, "hindsight");
    EXPECT_FALSE(episode.steps.empty());
  }
}

TEST(HindsightTest, ClocksThatAreSetBackTellEachGoalInItsTime) {
  Path first;
  first.drive(5.0).stand(3.0).drive(5.0);
  std::vector<OdometryHeard> path = first.odometry();
  for (OdometryHeard heard : first.odometry()) {
    heard.stamp -= 50.0;
    path.push_back(heard);
  }
  const StepList steps = recorded(path);
  ASSERT_EQ(steps.episodes().size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Episode& episode = steps.episodes()[i].episode;
    EXPECT_EQ(episode.end, EpisodeEnd::kArrived);
    EXPECT_NEAR(episode.goal.pose.x, i % 2 == 0 ? 5.0 : 10.0, 1e-9);
    EXPECT_NEAR(episode.begun, (i < 2 ? 100.0 : 50.0) + (i % 2 == 0 ? 0.0 : 13.0), 0.5) << "one look late at most";
  }
}

TEST(HindsightTest, ParametersThatMakeNoSenseAreRefused) {
  const auto refusal = [](const HindsightParameters& parameters) {
    return test::refusalOf<std::invalid_argument>([&] { hindsightGoals({}, parameters, {}, "odom"); });
  };
  EXPECT_EQ(refusal({0.0, 10.0, 2.0}), "parameter stop is 0, expected a number in [0.01, 86400]");
  EXPECT_EQ(refusal({2.0, 1.0, 2.0}), "parameter longest is 1, expected at least shortest = 2");
  EXPECT_EQ(refusal({2.0, 10.0, NAN}), "parameter shortest is nan, expected a number in [0.01, 100000]");
  EXPECT_EQ(refusal({2.0, 10.0, 0.3}), "parameter shortest is 0.3, expected more than the goal tolerance of 0.3");
}

}  // namespace
}  // namespace lstm_planner::test_hindsight
