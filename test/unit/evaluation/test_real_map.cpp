#include <gtest/gtest.h>

#include <fstream>

#include "lstm_planner/agent/drive_policy.hpp"
#include "lstm_planner/evaluation/drive.hpp"
#include "real_data.hpp"

namespace lstm_planner {
namespace {

TEST(RealMapDrive, ShippedModelArrivesInWillowWithoutContact) {
  if (!std::ifstream(willowMap())) GTEST_SKIP() << "no map " << willowMap();
  const GridWorld world(readMapServerMap(willowMap(), kWillowFreeThreshold));
  const DrivePolicy policy = DrivePolicy::fromFile(shippedModel());
  const std::vector<DriveTask> tasks = drawTasksBetween(world, 3, 5.0, 15.0);
  ASSERT_EQ(tasks.size(), 3u);
  for (const DriveTask& task : tasks) {
    NavigationAgent agent(policy, AgentParameters{});
    const DriveResult result = drive(world, task, DriveParameters{}, 1, &agent);
    EXPECT_EQ(result.end, DriveResult::End::kReached)
        << "from (" << task.start.x << ", " << task.start.y << ") to (" << task.goal.x << ", " << task.goal.y << ")";
    EXPECT_EQ(result.contacts, 0);
  }
}

}  // namespace
}  // namespace lstm_planner
