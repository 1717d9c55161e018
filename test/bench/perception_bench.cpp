#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/perception/drift_correction.hpp"
#include "lstm_planner/drive/perception/moving_returns.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "recorded_steps.hpp"

namespace lstm_planner::perception_bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kRangeCap = 6.0;

/// What the agent knows at each step of the recorded drives.
const std::vector<Situation>& situations() {
  static const std::vector<Situation> situations = [] {
    std::vector<Situation> all;
    for (const RecordedDrive& drive : recordedDrives()) {
      for (const RecordedStep& step : drive.steps) {
        all.emplace_back();
        perceive(step.scan, drive.mount, Hokuyo::rules(), kRangeCap, &all.back());
        all.back().pose = step.pose;
        all.back().time = step.time;
      }
    }
    return all;
  }();
  return situations;
}

/// Scans of a robot that stands in an office: they differ by noise alone.
std::vector<Situation> standing() {
  constexpr int kScans = 200;
  const GridWorld world(generateWorld(WorldKind::kOffice, worldSeed(WorldUse::kJudging, 1, 0)));
  const ShieldParameters shield;
  const Pose2 pose = drawTasks(world, 1, shield.footprint_radius, shield.clearance, 10.0, 1)[0].start;
  Hokuyo scanner(HokuyoParameters(), 1);
  std::vector<Situation> all(kScans);
  LaserScan scan;
  for (Situation& situation : all) {
    scanner.scan(world, pose, 0.0, &scan);
    perceive(scan, {}, {}, kRangeCap, &situation);
    situation.pose = pose;
  }
  return all;
}

/// Times of the calls of a sequence that is repeated. Of the same call in several passes the shortest counts: what
/// other programs on the machine do to one call they hardly do to it each time.
class CallTimes {
 public:
  explicit CallTimes(std::size_t calls) : times_(calls, std::numeric_limits<double>::infinity()) {}

  template <typename Call>
  void time(std::size_t index, const Call& call) {
    const Clock::time_point begin = Clock::now();
    call();
    const std::chrono::duration<double, std::micro> taken = Clock::now() - begin;
    times_[index] = std::min(times_[index], taken.count());
  }

  void report(benchmark::State* state) {
    std::sort(times_.begin(), times_.end());
    double sum = 0.0;
    for (const double time : times_) sum += time;
    state->counters["median_us"] = times_[times_.size() / 2];
    state->counters["mean_us"] = sum / static_cast<double>(times_.size());
    state->counters["p99_us"] = times_[times_.size() * 99 / 100];
  }

 private:
  std::vector<double> times_;
};

constexpr int kPasses = 20;

/// A scan of 1081 beams becomes sectors, points and a profile.
void perceiving(benchmark::State& state) {
  CallTimes times(situations().size());
  Situation situation;
  for (auto _ : state) {
    std::size_t call = 0;
    for (const RecordedDrive& drive : recordedDrives()) {
      for (const RecordedStep& step : drive.steps) {
        times.time(call++, [&] { perceive(step.scan, drive.mount, Hokuyo::rules(), kRangeCap, &situation); });
        benchmark::DoNotOptimize(situation.obstacles.data());
      }
    }
  }
  times.report(&state);
}
BENCHMARK(perceiving)->Iterations(kPasses)->Unit(benchmark::kMillisecond);

/// Each scan of the drives; every fourth or so is matched.
void correctingDrift(benchmark::State& state) {
  CallTimes times(situations().size());
  Situation situation;
  for (auto _ : state) {
    DriftCorrection drift;
    std::size_t call = 0;
    for (const Situation& seen : situations()) {
      situation = seen;
      if (situation.time == 0.0) drift.restart();  // another drive
      times.time(call++, [&] { drift.correct(&situation); });
    }
  }
  times.report(&state);
}
BENCHMARK(correctingDrift)->Iterations(kPasses)->Unit(benchmark::kMillisecond);

/// What a decision asks the shield: every steering angle, with both clearances, and the direction of the route.
void shielding(benchmark::State& state) {
  const AgentParameters agent;
  const ShieldParameters& parameters = agent.shield;
  const ActionSet actions;
  Shield shield(Footprint(parameters.footprint_radius), parameters.tight_clearance, parameters.reach);
  CallTimes times(situations().size());
  Situation situation;
  for (auto _ : state) {
    std::size_t call = 0;
    for (const Situation& seen : situations()) {
      situation = seen;  // in the cache, as when it was perceived just now
      times.time(call++, [&] {
        shield.show(situation.obstacles);
        double sum = 0.0;
        for (const double clearance : {parameters.clearance, parameters.tight_clearance}) {
          for (int action = 0; action < actions.size(); ++action) {
            sum += shield.freeDistance({}, actions.angle(action), agent.step.length, clearance);
          }
        }
        sum += shield.freeDistance({}, 0.3, agent.step.length, parameters.tight_clearance);
        benchmark::DoNotOptimize(sum);
      });
    }
  }
  times.report(&state);
}
BENCHMARK(shielding)->Iterations(kPasses)->Unit(benchmark::kMillisecond);

void remember(const std::vector<Situation>& seen, benchmark::State* state) {
  const AgentParameters agent;
  LocalMap memory(agent.memory, agent.shield);
  CallTimes times(seen.size());
  double last = 0.0;
  Situation situation;
  for (auto _ : *state) {
    std::size_t call = 0;
    for (const Situation& next : seen) {
      situation = next;
      if (situation.time < last) memory.forget();  // the next drive starts
      last = situation.time;
      times.time(call++, [&] { memory.add(situation); });
    }
  }
  times.report(state);
}

/// Every scan of the drives, ten a second.
void lookDriving(benchmark::State& state) { remember(situations(), &state); }
BENCHMARK(lookDriving)->Iterations(kPasses)->Unit(benchmark::kMillisecond);

void lookStanding(benchmark::State& state) { remember(standing(), &state); }
BENCHMARK(lookStanding)->Iterations(kPasses)->Unit(benchmark::kMillisecond);

/// Judges every cell of the window after the drives.
void judging(benchmark::State& state) {
  const AgentParameters agent;
  LocalMap memory(agent.memory, agent.shield);
  for (const Situation& situation : situations()) memory.add(situation);
  const int cells = memory.side() * memory.side();
  long exits = 0;
  for (auto _ : state) {
    memory.relaxClearance(true);  // All that was judged is judged anew.
    memory.relaxClearance(false);
    for (int cell = 0; cell < cells; ++cell) exits += memory.exits(cell);
  }
  benchmark::DoNotOptimize(exits);
  state.counters["ns_per_cell"] =
      benchmark::Counter(static_cast<double>(cells) * static_cast<double>(state.iterations()) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(judging)->Unit(benchmark::kMillisecond);

void findingMovingReturns(benchmark::State& state) {
  MovingReturns moving{MovingReturnsParameters()};
  CallTimes times(situations().size());
  Situation situation;
  for (auto _ : state) {
    std::size_t call = 0;
    for (const Situation& seen : situations()) {
      situation = seen;
      times.time(call++, [&] { moving.show(situation.profile, situation.pose, situation.time); });
      benchmark::DoNotOptimize(moving.points().data());
    }
  }
  times.report(&state);
}
BENCHMARK(findingMovingReturns)->Iterations(kPasses)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lstm_planner::perception_bench
