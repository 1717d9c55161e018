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

/// What the robot does in drives of 5 to 15 m.
std::vector<DriveResult> driveInWillow(const DrivePolicy& policy, const AgentParameters& parameters, int drives = 3) {
  const GridWorld world(readMapServerMap(willowMap(), kWillowFreeThreshold));
  std::vector<DriveResult> results;
  for (const DriveTask& task : drawTasksBetween(world, drives, 5.0, 15.0)) {
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

/// Success weighted by path length (Anderson et al. 2018): mean of shortest / driven path, 0 for a drive that did not
/// arrive.
double efficiencyOf(const std::vector<DriveResult>& results) {
  double sum = 0.0;
  for (const DriveResult& result : results) {
    if (result.end == DriveResult::End::kReached)
      sum += result.shortest / std::max(result.shortest, result.path_length);
  }
  return sum / static_cast<double>(results.size());
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
  constexpr int kDrives = 5;  // all that drawTasksBetween() finds
  const std::vector<DriveResult> alone = driveInWillow(DrivePolicy::fromFile(shippedModel()), parameters, kDrives);
  ASSERT_EQ(static_cast<int>(alone.size()), kDrives);
  EXPECT_EQ(countContacts(alone), 0);
  // In buildings 19 of 20 drives arrive, on 2.1 times the shortest path (models/create2_lstm.md): 0.95 / 2.1.
  EXPECT_GT(efficiencyOf(alone), 0.45);
  EXPECT_LT(efficiencyOf(driveInWillow(test::straightAheadPolicy(), parameters, kDrives)), 0.1);
}

}  // namespace
}  // namespace lstm_planner::test_real_map
