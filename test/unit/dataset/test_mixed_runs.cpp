#include <gtest/gtest.h>

#include <algorithm>

#include "lstm_planner/dataset/mixed_runs.hpp"

namespace lstm_planner::test_mixed_runs {
namespace {

constexpr double kMaxSpeed = 1.0;  // m/s

/// Straight on for ten seconds at 10 Hz and 0.5 m/s.
std::vector<OdometryHeard> runFrom(double start, double y) {
  std::vector<OdometryHeard> run;
  for (int i = 0; i <= 100; ++i) run.push_back({start + 0.1 * i, {0.05 * i, y, 0.0}, {}});
  return run;
}

std::vector<OdometryHeard> inOrder(const std::vector<std::vector<OdometryHeard>>& runs) {
  std::vector<OdometryHeard> path;
  for (const auto& run : runs) path.insert(path.end(), run.begin(), run.end());
  std::stable_sort(path.begin(), path.end(),
                   [](const OdometryHeard& a, const OdometryHeard& b) { return a.stamp < b.stamp; });
  return path;
}

TEST(MixedRuns, AreFoundWhereRunsHaveTheSameTimes) {
  const auto two = mixedRuns(inOrder({runFrom(0.0, 0.0), runFrom(5.03, 4.0)}), kMaxSpeed);
  ASSERT_TRUE(two.has_value());
  EXPECT_DOUBLE_EQ(two->first, 5.1);
  EXPECT_DOUBLE_EQ(two->second, 10.03);
  EXPECT_TRUE(mixedRuns(inOrder({runFrom(0.0, 0.0), runFrom(0.03, 4.0), runFrom(0.06, 8.0)}), kMaxSpeed).has_value());
}

TEST(MixedRuns, AreFoundWhereTheyBeginAtTheSamePlace) {
  std::vector<OdometryHeard> slower = runFrom(0.03, 0.0);
  for (OdometryHeard& heard : slower) heard.pose.x *= 0.5;
  EXPECT_TRUE(mixedRuns(inOrder({runFrom(0.0, 0.0), slower}), kMaxSpeed).has_value());
}

TEST(MixedRuns, AreNoRunsOneAfterTheOther) {
  EXPECT_FALSE(mixedRuns(runFrom(0.0, 0.0), kMaxSpeed).has_value());
  EXPECT_FALSE(mixedRuns(inOrder({runFrom(0.0, 0.0), runFrom(10.1, 4.0), runFrom(20.2, 0.0)}), kMaxSpeed).has_value());
}

TEST(MixedRuns, AreNoWrongMessagesOfADriver) {
  std::vector<OdometryHeard> path = runFrom(0.0, 4.0);
  for (std::size_t i = 0; i < path.size(); i += 5) path[i].pose = {};
  EXPECT_FALSE(mixedRuns(path, kMaxSpeed).has_value());
}

}  // namespace
}  // namespace lstm_planner::test_mixed_runs
