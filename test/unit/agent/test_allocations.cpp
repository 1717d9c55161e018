#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "bench/recorded_steps.hpp"
#include "lstm_planner/agent/online_agent.hpp"
#include "lstm_planner/agent/rollout.hpp"
#include "unit/heap_count.hpp"

namespace lstm_planner {
namespace {

/// What a planner does in a drive, from the scan to the plan.
class Driver {
 public:
  explicit Driver(const AgentParameters& parameters = {})
      : parameters_(parameters), agent_(shippedPolicy(), parameters_) {}

  /// Each drive begins at another place: what was seen in the one before is forgotten.
  void run(const RecordedDrive& drive) {
    ++jumps_;
    bool is_new = true;
    for (const RecordedStep& step : drive.steps) {
      agent_.look(step.scan, drive.mount, step.pose, step.time);
      agent_.drive({drive.goal.x, drive.goal.y}, is_new, jumps_);
      rollOut(agent_.situation(), agent_.decision(), agent_.shield(), drive.goal, parameters_, {}, &plan_);
      is_new = false;
    }
  }

  long steps() const { return agent_.decision().step; }

 private:
  AgentParameters parameters_;
  OnlineAgent agent_;
  std::vector<Pose2> plan_;
  long jumps_ = 0;
};

TEST(HeapCount, SeesAllThatIsAskedFor) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  const HeapCount before = heapCount();
  auto block = std::make_unique<std::vector<double>>(1000);
  const HeapCount during = heapCount();
  EXPECT_EQ(during.allocations, before.allocations + 2);
  EXPECT_GE(during.live_bytes, before.live_bytes + 8000);
  block.reset();
  EXPECT_EQ(heapCount().live_bytes, before.live_bytes);
}

TEST(Allocations, NoneFromScanToPlanOnceWarm) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  Driver driver;
  for (const RecordedDrive& drive : recordedDrives()) driver.run(drive);
  for (const RecordedDrive& drive : recordDrives(2)) {
    const long before = heapCount().allocations;
    driver.run(drive);
    EXPECT_EQ(heapCount().allocations, before) << "in the " << drive.world;
    EXPECT_GT(driver.steps(), 20) << "the " << drive.world << " is hardly a drive";
  }
}

/// Bytes that a planner holds of the heap when it has driven.
long heldBytes(const AgentParameters& parameters) {
  const std::vector<RecordedDrive>& drives = recordedDrives();
  const long before = heapCount().live_bytes;
  auto driver = std::make_unique<Driver>(parameters);
  for (const RecordedDrive& drive : drives) driver->run(drive);
  return heapCount().live_bytes - before;
}

TEST(Allocations, TheRescueKeepsAtMostOneMegabyte) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  AgentParameters without;
  without.memory.enabled = false;
  EXPECT_LE(heldBytes({}) - heldBytes(without), 1 << 20);
}

TEST(Allocations, TheAgentWithoutRescueKeepsAtMost96Kibibytes) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  // Weights, hidden states, encoder, trace and boundary following; not the scan it is shown, nor the plan.
  AgentParameters parameters;
  parameters.memory.enabled = false;
  const long before = heapCount().live_bytes;
  auto agent = std::make_unique<NavigationAgent>(shippedPolicy(), parameters);
  const long built = heapCount().live_bytes - before;
  const RecordedDrive& drive = recordedDrives().front();
  Situation situation;
  situation.obstacles.reserve(2 * drive.steps.front().scan.ranges.size());
  agent->setGoal({drive.goal.x, drive.goal.y});
  perceive(drive.steps.front().scan, drive.mount, {}, agent->policy().description().encoder.range_cap, &situation);
  const long seen = heapCount().live_bytes;
  agent->update(situation);
  EXPECT_LE(built + heapCount().live_bytes - seen, 96 << 10);
}

}  // namespace
}  // namespace lstm_planner
