#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bench/recorded_steps.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "support/heap_count.hpp"

namespace lstm_planner::test_allocations {
namespace {

/// What a planner does in a drive, from the scan to the plan.
class Driver {
 public:
  explicit Driver(const AgentParameters& parameters = {})
      : parameters_(parameters), agent_(shippedPolicy(), parameters_) {}

  /// Each drive starts at another place: what was seen in the one before is forgotten.
  void run(const RecordedDrive& drive) {
    agent_.setGoal({drive.goal.x, drive.goal.y});
    agent_.restart();
    for (const RecordedStep& step : drive.steps) {
      perceive(step.scan, drive.mount, Hokuyo::rules(), agent_.policy().description().encoder.range_cap, &situation_);
      situation_.pose = step.pose;
      situation_.time = step.time;
      agent_.perceive(situation_);
      agent_.decide();
      rollOut(agent_.situation(), agent_.decision(), agent_.shield(), drive.goal, parameters_, {}, &plan_);
    }
  }

  void reservePlan() { plan_.reserve(kMostPlanPoses); }

  long steps() const { return agent_.decision().step; }

 private:
  AgentParameters parameters_;
  NavigationAgent agent_;
  std::vector<Pose2> plan_;
  Situation situation_;
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
  driver.reservePlan();  // the caller's: a longer path has more poses
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

TEST(Allocations, TheRescueKeepsAtMost1200Kilobytes) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  AgentParameters without;
  without.memory.enabled = false;
  EXPECT_LE(heldBytes({}) - heldBytes(without), 1200000);
}

/// The same as a URG-04LX sees it, the thesis's scanner: 683 beams over 240 degrees.
LaserScan asOf683Beams(const LaserScan& scan) {
  LaserScan sparse = scan;
  sparse.angle_min = -2.0 * M_PI / 3.0;
  sparse.angle_increment = 4.0 * M_PI / 3.0 / 682.0;
  sparse.ranges.clear();
  for (int beam = 0; beam < 683; ++beam) {
    const double angle = sparse.angle_min + beam * sparse.angle_increment;
    sparse.ranges.push_back(scan.ranges.at(static_cast<std::size_t>((angle - scan.angle_min) / scan.angle_increment)));
  }
  return sparse;
}

/// Bytes of the heap that an agent without boundary following holds: weights, hidden states, encoder, trace, shield and
/// boundary following; not the scan it is shown, nor the plan, nor what is set up once in a process to read model
/// files.
long heldWithoutRescue(const RecordedDrive& drive, const LaserScan& scan) {
  shippedPolicy();
  AgentParameters parameters;
  parameters.memory.enabled = false;
  const long before = heapCount().live_bytes;
  auto agent = std::make_unique<NavigationAgent>(shippedPolicy(), parameters);
  const long built = heapCount().live_bytes - before;
  Situation situation;
  agent->setGoal({drive.goal.x, drive.goal.y});
  perceive(scan, drive.mount, Hokuyo::rules(), agent->policy().description().encoder.range_cap, &situation);
  const long seen = heapCount().live_bytes;
  const Situation copy = situation;
  const long of_the_scan = heapCount().live_bytes - seen;
  agent->perceive(situation);
  agent->decide();
  return built + heapCount().live_bytes - seen - 2 * of_the_scan;
}

TEST(Allocations, TheAgentWithoutRescueKeepsAtMost64Kibibytes) {
  if (!heapIsCounted()) GTEST_SKIP() << kHeapIsNotCounted;
  const RecordedDrive& drive = recordedDrives().front();
  const LaserScan& scan = drive.steps.front().scan;
  const long held = heldWithoutRescue(drive, asOf683Beams(scan));
  EXPECT_LE(held, 64 << 10);
  RecordProperty("bytes_683_beams", std::to_string(held));
  RecordProperty("bytes_1081_beams", std::to_string(heldWithoutRescue(drive, scan)));
}

}  // namespace
}  // namespace lstm_planner::test_allocations
