#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "support/real_data.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_real_map {
namespace {

/// As far as a drive may go, as a multiple of the shortest path that knows the map.
constexpr double kLongestPath = 2.0;

/// What the robot does in three drives of 5 to 15 m.
std::vector<DriveResult> driveInWillow(const DrivePolicy& policy, const AgentParameters& parameters) {
  const GridWorld world(readMapServerMap(willowMap(), kWillowFreeThreshold));
  std::vector<DriveResult> results;
  for (const DriveTask& task : drawTasksBetween(world, 3, 5.0, 15.0)) {
    NavigationAgent agent(policy, parameters);
    results.push_back(drive(world, task, DriveParameters{}, 1, &agent));
  }
  return results;
}

/// Number of drives that arrive on a path that is not too long.
int countGood(const std::vector<DriveResult>& results) {
  return static_cast<int>(std::count_if(results.begin(), results.end(), [](const DriveResult& result) {
    return result.end == DriveResult::End::kReached && result.path_length <= kLongestPath * result.shortest;
  }));
}

int countContacts(const std::vector<DriveResult>& results) {
  int contacts = 0;
  for (const DriveResult& result : results) contacts += result.contacts;
  return contacts;
}

TEST(RealMapDrive, ShippedPlannerArrivesInWillowWithoutContact) {
  SKIP_WITHOUT_REAL_DATA(willowMap());
  const std::vector<DriveResult> results = driveInWillow(DrivePolicy::fromFile(shippedModel()), AgentParameters{});
  EXPECT_EQ(countGood(results), 3);
  EXPECT_EQ(countContacts(results), 0);
}

TEST(RealMapDrive, AloneTheShippedNetworkArrivesInWillowAndAUselessOneDoesNot) {
  SKIP_WITHOUT_REAL_DATA(willowMap());
  AgentParameters parameters;
  const std::vector<DriveResult> useless = driveInWillow(test::straightAheadPolicy(), parameters);
  EXPECT_EQ(countGood(useless), 3) << "under the bound any network arrives";
  EXPECT_EQ(countContacts(useless), 0);

  parameters.escape.enabled = false;
  parameters.memory.enabled = false;
  const std::vector<DriveResult> alone = driveInWillow(DrivePolicy::fromFile(shippedModel()), parameters);
  EXPECT_EQ(countGood(alone), 3);
  EXPECT_EQ(countContacts(alone), 0);
  EXPECT_EQ(countGood(driveInWillow(test::straightAheadPolicy(), parameters)), 0);
}

}  // namespace
}  // namespace lstm_planner::test_real_map
