// What a costmap has marked, as the memory takes it over.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lstm_planner/drive/local_map/local_map.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_obstacle_marks {
namespace {

using Passage = LocalMap::Passage;
using test::seenFrom;

const AgentParameters kDefaults;
const Pose2 kRobot{4.0, 4.0, 0.0};
const Point2 kMark{5.0, 4.0};  // in the hall; 1 m ahead of the robot

class ObstacleMarksTest : public ::testing::Test {
 protected:
  ObstacleMarksTest() : hall_(test::emptyHall(8.0, 8.0)), memory_(kDefaults.memory, kDefaults.shield) {}

  /// The robot looks around in the empty hall; a costmap has these obstacles (odometry frame), too.
  void sense(const std::vector<Point2>& marks, const Pose2& pose = kRobot) {
    Situation situation = seenFrom(GridWorld(hall_), pose);
    for (const Point2& place : marks) situation.marked.push_back(toLocalFrame(pose, place));
    memory_.add(situation);
  }
  bool isBlocked(const Point2& place) const { return !memory_.isFree(place, place, Passage::kTight); }

  OccupancyGrid hall_;
  LocalMap memory_;
};

TEST_F(ObstacleMarksTest, StandWhereTheScanSeesNothing) {
  for (int i = 0; i < 3; ++i) {
    sense({kMark});
    EXPECT_TRUE(isBlocked(kMark)) << "although the scan shows it clear";
  }
}

TEST_F(ObstacleMarksTest, AreGoneAsSoonAsTheCostmapIsCleared) {
  sense({kMark, {5.0, 4.2}});
  sense({{5.0, 4.2}});
  EXPECT_FALSE(isBlocked({5.0, 3.9}));
  EXPECT_TRUE(isBlocked({5.0, 4.2}));
  sense({});
  EXPECT_FALSE(isBlocked({5.0, 4.2}));
}

TEST_F(ObstacleMarksTest, AreOneSquareAsLongAsTheyStay) {
  sense({});
  const std::size_t without = memory_.obstacles().size();
  for (int i = 0; i < 2; ++i) {
    sense({kMark});
    EXPECT_EQ(memory_.obstacles().size(), without + 1);
  }
  sense({});
  EXPECT_EQ(memory_.obstacles().size(), without);
}

TEST_F(ObstacleMarksTest, TakeNothingAwayThatTheScanHasSeen) {
  test::fillBox(5.0, 3.7, 5.3, 4.3, &hall_);
  const Point2 on_the_box{5.02, 4.0};
  sense({});
  ASSERT_TRUE(isBlocked(on_the_box));
  const Pose2 away{4.0, 4.0, M_PI};
  sense({on_the_box}, away);
  sense({}, away);
  EXPECT_TRUE(isBlocked(on_the_box));
}

TEST_F(ObstacleMarksTest, InOrBesideASquareThatTheScanHasSeenAreNoneOfTheirOwn) {
  test::fillBox(5.0, 3.7, 5.3, 4.3, &hall_);
  const Pose2 away{4.0, 4.0, M_PI};
  sense({});
  sense({}, away);
  const std::vector<Point2> seen = memory_.obstacles();
  Point2 lowest{5.0, 5.0};  // of the side of the box that the robot sees
  for (const Point2& place : seen) {
    if (std::abs(place.x - 5.0) < 0.1 && std::abs(place.y - 4.0) < 0.5 && place.y < lowest.y) lowest = place;
  }
  ASSERT_LT(lowest.y, 4.0);
  const double square = kDefaults.memory.resolution;
  for (const int squares : {0, 1, 2}) {
    sense({{lowest.x, lowest.y - squares * square}}, away);
    EXPECT_EQ(memory_.obstacles().size(), seen.size() + (squares < 2 ? 0 : 1)) << squares << " squares beside";
    sense({}, away);
    EXPECT_EQ(memory_.obstacles().size(), seen.size()) << squares << " squares beside";
  }
}

TEST_F(ObstacleMarksTest, StayWhereTheyAreWhenTheWindowMoves) {
  sense({kMark});
  sense({kMark}, {4.0 + 0.25 * kDefaults.memory.width, 4.0, 0.0});
  EXPECT_FALSE(isBlocked(kMark)) << "now out of reach";
  sense({kMark});
  EXPECT_TRUE(isBlocked(kMark));
  sense({});
  EXPECT_FALSE(isBlocked(kMark));
}

TEST_F(ObstacleMarksTest, UnderTheRobotAreNone) {
  sense({{kRobot.x, kRobot.y}});
  EXPECT_FALSE(isBlocked({kRobot.x, kRobot.y}));
}

TEST_F(ObstacleMarksTest, AreForgottenWithEverythingElse) {
  sense({kMark});
  memory_.forget();
  sense({});
  EXPECT_FALSE(isBlocked(kMark));
}

}  // namespace
}  // namespace lstm_planner::test_obstacle_marks
