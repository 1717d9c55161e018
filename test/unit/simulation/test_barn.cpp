#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "lstm_planner/simulation/barn.hpp"
#include "support/folder_test.hpp"
#include "support/real_data.hpp"
#include "support/refusal.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_barn {
namespace {

class BarnFile : public test::FolderTest {
 protected:
  std::string write(const std::string& name, const std::string& text) const { return scratch_.write(name, text); }
  /// What readBarnWorlds() says about a file of cylinders.
  std::string refusal(const std::string& text) const {
    return test::refusalOf([&] { readBarnWorlds(write("cylinders.csv", text)); });
  }
};

TEST_F(BarnFile, IsReadInAnyOrderOfLinesAndColumns) {
  const std::string path = write("cylinders.csv", "y,world,x\r\n2.5,7,1.5\r\n\r\n3.5,4,-1\r\n4.5,7,1\r\n");
  write("barn_reference_paths.csv", "world,path_points,path_length_m\n7,3,12.5\n");
  const std::vector<BarnWorld> worlds = readBarnWorlds(path);
  ASSERT_EQ(worlds.size(), 2u);
  EXPECT_EQ(worlds[0].number, 4);
  EXPECT_EQ(worlds[1].number, 7);
  ASSERT_EQ(worlds[1].circles.size(), 2u);
  EXPECT_EQ(worlds[1].circles[0].center.x, 1.5);
  EXPECT_EQ(worlds[1].circles[0].center.y, 2.5);
  EXPECT_EQ(worlds[1].circles[0].radius, 0.075);
  EXPECT_EQ(worlds[0].task.shortest, 0.0) << "its reference path is not known";
  EXPECT_EQ(worlds[1].task.shortest, 12.5);
  EXPECT_EQ(distanceBetween(worlds[0].task.start, worlds[0].task.goal), 10.0);
}

TEST_F(BarnFile, IsRefusedWithTheLineAtFault) {
  EXPECT_NE(refusal("world,x\n1,2\n").find("names no column 'y'"), std::string::npos);
  EXPECT_NE(refusal("world,x,y\n1,2,3\n1,2,three\n").find("line 3: column y is 'three'"), std::string::npos);
  EXPECT_NE(refusal("world,x,y\n1,2\n").find("line 2: column y is ''"), std::string::npos);
  EXPECT_NE(refusal("world,x,y\n1.5,2,3\n").find("whole number"), std::string::npos);
  EXPECT_NE(refusal("world,x,y\n").find("holds no cylinder"), std::string::npos);
  EXPECT_THROW(readBarnWorlds(in("none.csv")), std::invalid_argument);
}

TEST(BarnScore, RewardsFastArrivalsWithoutContacts) {
  DriveResult result;
  result.end = DriveResult::End::kReached;
  result.shortest = 12.0;  // 6 s at 2 m/s
  result.time = 36.0;
  EXPECT_DOUBLE_EQ(barnScore(result, 4.0), 6.0 / 36.0);
  result.time = 18.0;
  EXPECT_DOUBLE_EQ(barnScore(result, 4.0), 1.0 / 4.0) << "no better than four times the reference";
  EXPECT_DOUBLE_EQ(barnScore(result, 2.0), 1.0 / 3.0);
  result.time = 90.0;
  EXPECT_DOUBLE_EQ(barnScore(result, 4.0), 1.0 / 8.0) << "no worse than eight times the reference";
  result.contacts = 1;
  EXPECT_EQ(barnScore(result, 4.0), 0.0);
  result.contacts = 0;
  result.end = DriveResult::End::kTimeout;
  EXPECT_EQ(barnScore(result, 4.0), 0.0);
  result.end = DriveResult::End::kReached;
  result.shortest = 0.0;
  EXPECT_EQ(barnScore(result, 4.0), 0.0) << "no reference";
}

TEST(BarnDrive, IsEndedByTheRefereeAMetreBeforeTheGoal) {
  const CircleWorld world({});
  const DriveTask task{{-2.25, 3.0, M_PI_2}, {-2.25, 13.0}, 10.0};
  NavigationAgent agent(test::straightAheadPolicy(), {});
  const DriveResult result = drive(world, task, barnRules(test::quickDrive(1800.0)), 1, &agent);
  EXPECT_EQ(result.end, DriveResult::End::kReached);
  EXPECT_LE(result.goal_error, 1.0);
  EXPECT_GT(result.goal_error, 0.96) << "seen at the next command, 0.1 s or 3 cm later";
}

TEST(RealBarn, HoldsWorldsWithAFreeStartAndReferencePathsOfTenMetresAtLeast) {
  const std::string path = realData("barn/barn_cylinders.csv");
  SKIP_WITHOUT_REAL_DATA(path);
  const std::vector<BarnWorld> worlds = readBarnWorlds(path);
  EXPECT_EQ(worlds.size(), 250u);
  for (const BarnWorld& world : worlds) {
    EXPECT_GE(world.task.shortest, 10.0) << world.number;
    EXPECT_FALSE(CircleWorld(world.circles).touches({world.task.start.x, world.task.start.y}, 0.17425)) << world.number;
  }
}

}  // namespace
}  // namespace lstm_planner::test_barn
