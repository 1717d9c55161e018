#include <benchmark/benchmark.h>

#include <string>
#include <utility>

#include "bench_support.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "recorded_steps.hpp"

namespace lstm_planner::simulation_bench {
namespace {

constexpr std::uint64_t kSeed = 1;

OccupancyGrid benchWorld(const std::string& name) {
  if (name == "building") return readMapServerMap(std::string(LSTM_PLANNER_SOURCE_DIR) + "/config/demo_building.yaml");
  return generateWorld(worldKindOf(name), kSeed);
}

DriveTask benchTask(const GridWorld& world) {
  const ShieldParameters shield;
  return drawTasks(world, 1, shield.footprint_radius, shield.clearance, 5.0, kSeed)[0];
}

/// One scan of 1081 beams, with noise.
void simulatedScan(benchmark::State& state, const std::string& name) {
  const GridWorld world(benchWorld(name));
  SimulatedRobot robot(world, {}, benchTask(world).start, kSeed);
  LaserScan scan;
  for (auto _ : state) {
    robot.scan(&scan);
    benchmark::DoNotOptimize(scan.ranges.data());
  }
}
BENCHMARK_CAPTURE(simulatedScan, offices, "offices")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(simulatedScan, mazes, "mazes")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(simulatedScan, forest, "forest")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(simulatedScan, building, "building")->Unit(benchmark::kMicrosecond);

/// One physics period (20 ms) of a robot that turns in place and drives a little: wheels, odometry, contacts.
void simulatedStep(benchmark::State& state) {
  const GridWorld world(benchWorld("offices"));
  SimulatedRobot robot(world, {}, benchTask(world).start, kSeed);
  robot.command({0.05, 1.0});
  for (auto _ : state) robot.advance(SimulatedRobot::Parameters().physics_period);
  double x = robot.truePose().x;
  benchmark::DoNotOptimize(x);
}
BENCHMARK(simulatedStep)->Unit(benchmark::kNanosecond);

/// A whole drive as `lstm_planner drive` does it, ten commands and as many scans a simulated second.
void simulatedDrive(benchmark::State& state, const std::string& name) {
  const GridWorld world(benchWorld(name));
  const DriveTask task = benchTask(world);
  DriveParameters parameters;
  parameters.robot.latency = 0.1;
  parameters.time_limit = 300.0;
  NavigationAgent agent(shippedPolicy(), {});
  double seconds = 0.0;
  const WorkMeter meter;
  for (auto _ : state) seconds += drive(world, task, parameters, kSeed, &agent).time;
  meter.report("simulated_second", seconds, &state);
}
BENCHMARK_CAPTURE(simulatedDrive, offices, "offices")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulatedDrive, mazes, "mazes")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulatedDrive, building, "building")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lstm_planner::simulation_bench
