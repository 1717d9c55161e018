#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "recorded_steps.hpp"

namespace lstm_planner::rollout_bench {
namespace {

const AgentParameters kAgent;

const RecordedDrive& driveIn(const char* world) {
  for (const RecordedDrive& drive : recordedDrives()) {
    if (drive.world == world) return drive;
  }
  return recordedDrives().front();
}

Situation situationOf(const RecordedDrive& drive, const RecordedStep& step) {
  Situation situation;
  perceive(step.scan, drive.mount, Hokuyo::rules(), 6.0, &situation);
  situation.pose = step.pose;
  situation.time = step.time;
  return situation;
}

/// All that was seen on a drive.
LocalMap memoryOf(const RecordedDrive& drive) {
  LocalMap memory(kAgent.memory, kAgent.shield);
  for (const RecordedStep& step : drive.steps) memory.add(situationOf(drive, step));
  return memory;
}

/// A plan of so many steps through what one scan shows.
void rollOutPlan(benchmark::State& state) {
  const RecordedDrive& drive = driveIn("office");
  NavigationAgent agent(shippedPolicy(), kAgent);
  const RecordedStep& step = drive.steps.front();
  agent.perceive(situationOf(drive, step));
  agent.setGoal({drive.goal.x, drive.goal.y});
  agent.decide();
  Decision decision = agent.decision();
  decision.path_on.clear();  // as if nothing were remembered
  RolloutParameters parameters;
  parameters.steps = static_cast<int>(state.range(0));
  std::vector<Pose2> plan;
  for (auto _ : state) {
    rollOut(agent.situation(), decision, agent.shield(), drive.goal, kAgent, parameters, &plan);
    benchmark::DoNotOptimize(plan.data());
  }
  state.counters["poses"] = static_cast<double>(plan.size());
}
BENCHMARK(rollOutPlan)->Arg(1)->Arg(10);

/// From where the drive started to its goal, through all that was seen on it.
void searchRoute(benchmark::State& state, const char* world) {
  const RecordedDrive& drive = driveIn(world);
  LocalMap memory = memoryOf(drive);
  RouteFinder finder(kAgent.memory.tightness);
  const Pose2& start = drive.steps.front().pose;
  Route route;
  for (auto _ : state) {
    finder.find(memory, {start.x, start.y}, {drive.goal.x, drive.goal.y}, kAgent.goal_tolerance, &route);
    benchmark::DoNotOptimize(route.points.data());
  }
  state.counters["metres"] = route.length;
}
BENCHMARK_CAPTURE(searchRoute, office, "office");
BENCHMARK_CAPTURE(searchRoute, maze, "maze");

/// A robot that stands and sees what it saw before.
void keepRoute(benchmark::State& state, const char* world) {
  const RecordedDrive& drive = driveIn(world);
  const Situation situation = situationOf(drive, drive.steps.front());
  Replanner guide(kAgent.memory, kAgent.shield);
  guide.start();
  for (auto _ : state)
    benchmark::DoNotOptimize(guide.update(situation, {drive.goal.x, drive.goal.y}, kAgent.goal_tolerance));
}
BENCHMARK_CAPTURE(keepRoute, office, "office");
BENCHMARK_CAPTURE(keepRoute, maze, "maze");

/// Whole drives.
void updateRoute(benchmark::State& state, const char* world) {
  const RecordedDrive& drive = driveIn(world);
  std::vector<Situation> situations;
  for (std::size_t i = 0; i < drive.steps.size(); i += 5) situations.push_back(situationOf(drive, drive.steps[i]));
  long updates = 0;
  Replanner guide(kAgent.memory, kAgent.shield);
  for (auto _ : state) {
    guide.forget();
    guide.start();
    for (const Situation& situation : situations)
      benchmark::DoNotOptimize(guide.update(situation, {drive.goal.x, drive.goal.y}, kAgent.goal_tolerance));
    updates += static_cast<long>(situations.size());
  }
  state.SetItemsProcessed(updates);
}
BENCHMARK_CAPTURE(updateRoute, office, "office")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(updateRoute, maze, "maze")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lstm_planner::rollout_bench
