#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "call_times.hpp"
#include "lstm_planner/drive/decision/drive_trace.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/decision/observer.hpp"
#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/perception/moving_returns.hpp"
#include "recorded_steps.hpp"

namespace lstm_planner::decision_parts_bench {
namespace {

/// The parts of one decision.
struct PartTimes {
  LeastTime perceive;
  LeastTime moving_returns;
  LeastTime memory;
  LeastTime memory_and_route;
  LeastTime observe_and_network;
  LeastTime shield;
};

/// What an agent is made of, doing what an agent does with it in a recorded drive.
class Parts {
 public:
  Parts()
      : shield_(Footprint(parameters_.shield.footprint_radius), parameters_.shield.tight_clearance,
                parameters_.shield.reach) {}

  void begin(const RecordedDrive& drive) {
    goal_ = {drive.goal.x, drive.goal.y};
    memory_.forget();
    guide_.forget();
    guide_.start();
    trace_.clear();
    policy_.reset();
    moving_.reset();
  }

  void decide(const RecordedDrive& drive, const RecordedStep& step, PartTimes* times) {
    times->perceive.measure([&] {
      perceive(step.scan, drive.mount, Hokuyo::rules(), policy_.description().encoder.range_cap, &situation_);
    });
    situation_.pose = step.pose;
    situation_.time = step.time;
    times->moving_returns.measure([&] { moving_.show(situation_.profile, situation_.pose, situation_.time); });
    times->memory.measure([&] { memory_.add(situation_); });
    times->memory_and_route.measure([&] { guide_.update(situation_, goal_, parameters_.goal_tolerance); });
    times->observe_and_network.measure([&] {
      const Observation observation =
          observe(situation_, goal_, 0.0, policy_.description().encoder.position_cell, &trace_);
      benchmark::DoNotOptimize(policy_.advance(observation).data());
    });
    times->shield.measure([&] {
      shield_.show(situation_.obstacles);
      const ActionSet& actions = policy_.description().actions;
      for (int action = 0; action < actions.size(); ++action) {
        benchmark::DoNotOptimize(
            shield_.freeDistance({}, actions.angle(action), parameters_.step.length, parameters_.shield.clearance));
      }
    });
  }

 private:
  AgentParameters parameters_;
  DrivePolicy policy_ = shippedPolicy();
  Shield shield_;
  LocalMap memory_{parameters_.memory, parameters_.shield};
  Replanner guide_{parameters_.memory, parameters_.shield};
  DriveTrace trace_;
  MovingReturns moving_{MovingReturnsParameters()};
  Point2 goal_;
  Situation situation_;
};

/// Where the time of a decision goes, each part by itself, us (means over decisions twice a second, as a step has
/// them); one counter each. memory_and_route contains what memory does. Moving returns are the controller's, not the
/// planner's.
void decisionParts(benchmark::State& state) {
  constexpr std::size_t kEvery = 5;  // scans a decision
  Parts parts;
  std::vector<std::vector<PartTimes>> times;
  for (const RecordedDrive& drive : recordedDrives()) times.emplace_back(drive.steps.size() / kEvery);
  for (auto _ : state) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      const RecordedDrive& drive = recordedDrives()[i];
      parts.begin(drive);
      for (std::size_t k = 0; k < times[i].size(); ++k) parts.decide(drive, drive.steps[k * kEvery], &times[i][k]);
    }
  }
  const auto report = [&](const char* name, LeastTime PartTimes::*part) {
    std::vector<double> values;
    for (const std::vector<PartTimes>& drive : times) {
      for (const PartTimes& decision : drive) values.push_back((decision.*part).microseconds());
    }
    state.counters[name] = meanOf(values);
  };
  report("perceive_us", &PartTimes::perceive);
  report("moving_returns_us", &PartTimes::moving_returns);
  report("memory_us", &PartTimes::memory);
  report("memory_and_route_us", &PartTimes::memory_and_route);
  report("observe_and_network_us", &PartTimes::observe_and_network);
  report("shield_us", &PartTimes::shield);
}
BENCHMARK(decisionParts)->Iterations(20)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lstm_planner::decision_parts_bench
