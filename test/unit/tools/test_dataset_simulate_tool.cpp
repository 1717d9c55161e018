// The command `lstm_planner dataset simulate` as a user runs it.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "lstm_planner/dataset/dataset.hpp"
#include "support/tool_test.hpp"

namespace lstm_planner::test_dataset_simulate_tool {
namespace {

class DatasetSimulateTool : public test::ToolTest {
 protected:
  static std::string building() { return std::string(LSTM_PLANNER_SOURCE_DIR) + "/config/demo_building.yaml"; }

  test::Outcome simulate(const std::string& arguments) const {
    return runTool("dataset simulate --map " + building() + " --output " + in("drives.sqlite") + " " + arguments);
  }
};

TEST_F(DatasetSimulateTool, RecordsAsManyStepsAsWanted) {
  const test::Outcome outcome = simulate("--steps 41 --no-scans --seed 3");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("41 steps"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("0 contacts"), std::string::npos) << outcome.output;
  const Dataset dataset = readDataset(in("drives.sqlite"), true);
  ASSERT_EQ(dataset.recordings.size(), 1u);
  EXPECT_TRUE(dataset.recordings[0].finished);
  EXPECT_EQ(dataset.recordings[0].description.source, "simulation in " + building());
  EXPECT_EQ(stepCount(dataset), 41);
  EXPECT_TRUE(dataset.recordings[0].episodes[0].steps[0].ranges.empty());
}

TEST_F(DatasetSimulateTool, SharesTheStepsAmongSeveralMaps) {
  const test::Outcome outcome = simulate(building() + " --steps 41");
  ASSERT_EQ(outcome.status, 2) << "only --map takes files: " << outcome.output;
  const std::string maps = building() + " " + building();
  const test::Outcome both = runTool("dataset simulate --map " + maps + " --steps 41 --output " + in("two.sqlite"));
  ASSERT_EQ(both.status, 0) << both.output;
  const Dataset dataset = readDataset(in("two.sqlite"), true);
  ASSERT_EQ(dataset.recordings.size(), 2u);
  EXPECT_EQ(stepCount(dataset), 41);
  EXPECT_EQ(dataset.recordings[1].episodes[0].steps[0].ranges.size(), 1081u);
}

TEST_F(DatasetSimulateTool, DrivesToTheGoalsOfAFile) {
  const std::string goals = std::string(LSTM_PLANNER_SOURCE_DIR) + "/config/demo_goals.yaml";
  const test::Outcome outcome = simulate("--steps 10 --no-scans --waypoints " + goals);
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const Dataset dataset = readDataset(in("drives.sqlite"));
  const GoalInFrame& goal = dataset.recordings[0].episodes[0].episode.goal;
  EXPECT_EQ(goal.frame, "map");
  // Those in the file, but for the first, where the robot starts.
  EXPECT_TRUE(goal.pose.y == 1.25 || goal.pose.y == 8.25 || goal.pose.y == 10.5) << goal.pose.y;
}

TEST_F(DatasetSimulateTool, SaysWhatItCannotUse) {
  const auto saysOf = [&](const std::string& arguments) {
    const test::Outcome outcome = simulate(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    return outcome.output;
  };
  std::ofstream(in("odom.yaml")) << "waypoints: [[1, 2], [3, 4]]\nwaypoint_frame: odom\n";
  EXPECT_NE(saysOf("--waypoints " + in("odom.yaml")).find("waypoint_frame is odom, expected map"), std::string::npos);
  std::ofstream(in("text.yaml")) << "waypoints: [[1, 2], here]\n";
  EXPECT_NE(saysOf("--waypoints " + in("text.yaml")).find("expected [x, y]"), std::string::npos);
  std::ofstream(in("nowhere.yaml")) << "waypoints: [[1, 2], [.nan, 3]]\n";
  EXPECT_NE(saysOf("--waypoints " + in("nowhere.yaml")).find("waypoint 2 is not finite"), std::string::npos);
  EXPECT_NE(saysOf("--waypoints 99999999").find("expected a number below a million"), std::string::npos);
  EXPECT_NE(saysOf("--waypoints 1").find("there are 1 waypoints, expected at least two"), std::string::npos);
  EXPECT_NE(saysOf("--speed -1").find("--speed is -1, expected a number in [0.01, 10]"), std::string::npos);
  EXPECT_NE(saysOf("--steps 0").find("--steps is 0"), std::string::npos);
  std::ofstream(in("drives.sqlite")) << "mine";
  EXPECT_NE(saysOf("--steps 5").find("there is such a file already"), std::string::npos);
}

}  // namespace
}  // namespace lstm_planner::test_dataset_simulate_tool
