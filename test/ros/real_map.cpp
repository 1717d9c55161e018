// The demo, in a real building: simulated robot, plugins behind the action, one goal some rooms away.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "ros/fixtures/hand_made_model.hpp"
#include "ros/fixtures/ros_program.hpp"
#include "support/real_data.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner::real_map {
namespace {

void writeGoalsFile(const std::string& path, const DriveTask& task) {
  std::ofstream(path) << "frame: map\n"
                      << "start: [" << task.start.x << ", " << task.start.y << ", " << task.start.yaw << "]\n"
                      << "time_limit: 180.0\n"
                      << "goals: [{name: office, x: " << task.goal.x << ", y: " << task.goal.y << ", yaw: 0.0}]\n";
}

/// What the demo says of a drive to the task's goal.
nlohmann::json drive(const DriveTask& task, const std::string& arguments) {
  const test::ScratchFolder folder;
  writeGoalsFile(folder / "goals.yaml", task);
  const std::string command =
      "timeout --signal=INT 100 roslaunch lstm_planner demo.launch rviz:=false picture:=none "
      "real_time_factor:=4 map:=" +
      willowMap() + " free_threshold:=" + std::to_string(kWillowFreeThreshold) + " goals:=" + (folder / "goals.yaml") +
      " result:=" + (folder / "result") + arguments;
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream file(folder / "result");
  int exit_code = -1;
  file >> exit_code;
  EXPECT_EQ(exit_code, 0) << command;
  return nlohmann::json::parse(file);
}

/// Driven path over the shortest that knows the map.
double detour(const nlohmann::json& result) {
  const nlohmann::json& leg = result.at("legs").at(0);
  return leg.at("path_m").get<double>() / leg.at("shortest_m").get<double>();
}

TEST(RealMap, DemoArrivesInWillowOnAShortPathWithAnyNetwork) {
  SKIP_WITHOUT_REAL_DATA(willowMap());
  const GridWorld world(readMapServerMap(willowMap(), kWillowFreeThreshold));
  const std::vector<DriveTask> tasks = drawTasksBetween(world, 1, 6.0, 8.0);
  ASSERT_EQ(tasks.size(), 1u);

  const nlohmann::json result = drive(tasks.front(), "");
  EXPECT_EQ(result.at("reached"), 1);
  EXPECT_EQ(result.at("contacts"), 0);
  EXPECT_LT(detour(result), 1.5);

  // The bound keeps the path of any network short.
  const TemporaryModelFile useless(straightAheadModel());
  EXPECT_LT(detour(drive(tasks.front(), " leader:=network model:=" + useless.path())), 1.5);
}

const RosProgram program("real_map", &runTests);

}  // namespace
}  // namespace lstm_planner::real_map
