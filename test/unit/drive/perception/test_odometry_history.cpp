#include <gtest/gtest.h>

#include "lstm_planner/drive/perception/odometry_history.hpp"
#include "support/heap_count.hpp"

namespace lstm_planner::test_odometry_history {
namespace {

TEST(OdometryHistory, KeepsABoundedNumberOfEntriesWhereStampsHardlyGoOn) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  OdometryHistory history(1.0);
  const long before = heapCount().live_bytes;
  for (int i = 0; i < 100000; ++i) history.add({5.0 + 1e-9 * i, {}, {}});
  EXPECT_LT(heapCount().live_bytes - before, 1 << 20);
  EXPECT_EQ(history.jumps(), 0);
}

}  // namespace
}  // namespace lstm_planner::test_odometry_history
