#include <benchmark/benchmark.h>
#include <malloc.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "call_times.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "recorded_steps.hpp"

namespace lstm_planner::decision_bench {
namespace {

constexpr int kPasses = 20;
constexpr int kDecision = 1;  // steps of the rollout
constexpr int kMakePlan = 10;
constexpr int kCachesBytes = 8 << 20;  // more than the caches of one core hold

/// What move_base wants of a plan: geometry_msgs/PoseStamped without ROS.
struct StampedPose {
  unsigned sequence = 0;
  double stamp = 0.0;
  std::string frame;
  double x = 0.0, y = 0.0, z = 0.0;
  double qx = 0.0, qy = 0.0, qz = 0.0, qw = 1.0;
};

void toStampedPoses(const std::vector<Pose2>& plan, const Pose2& frame, std::vector<StampedPose>* poses) {
  const double c = std::cos(frame.yaw);
  const double s = std::sin(frame.yaw);
  poses->resize(plan.size());
  double yaw = std::numeric_limits<double>::quiet_NaN();
  double qz = 0.0;
  double qw = 1.0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    StampedPose& pose = (*poses)[i];
    if (plan[i].yaw != yaw) {  // the poses of a straight piece look the same way
      yaw = plan[i].yaw;
      qz = std::sin(0.5 * (yaw + frame.yaw));
      qw = std::cos(0.5 * (yaw + frame.yaw));
    }
    pose.frame = "map";
    pose.x = frame.x + c * plan[i].x - s * plan[i].y;
    pose.y = frame.y + s * plan[i].x + c * plan[i].y;
    pose.qz = qz;
    pose.qw = qw;
  }
}

/// Where the time of one call goes.
struct CallTime {
  LeastTime look;
  LeastTime drive;
  LeastTime roll_out;
  LeastTime poses;
  LeastTime whole;
  bool decides = false;  ///< rather than that the last decision still holds
};

/// Does the same drive again and again.
class Replay {
 public:
  Replay(const RecordedDrive& drive, int rollout_steps, bool cold)
      : drive_(drive), others_(cold ? kCachesBytes : 0), calls_(drive.steps.size()) {
    rollout_.steps = rollout_steps;
  }

  void run(NavigationAgent* agent) {
    agent->setGoal({drive_.goal.x, drive_.goal.y});
    agent->restart();
    for (std::size_t i = 0; i < drive_.steps.size(); ++i) {
      forgetCaches();
      call(drive_.steps[i], i == 0, agent, &calls_[i]);
    }
  }

  const std::vector<CallTime>& calls() const { return calls_; }

 private:
  void forgetCaches() {
    for (std::size_t i = 0; i < others_.size(); i += 64) ++others_[i];
    benchmark::ClobberMemory();
  }

  void call(const RecordedStep& step, bool is_new, NavigationAgent* agent, CallTime* time) {
    const long last_step = is_new ? 0 : agent->decision().step;
    const Point2 last_waypoint = agent->decision().waypoint;
    time->whole.measure([&] {
      time->look.measure([&] {
        perceive(step.scan, drive_.mount, Hokuyo::rules(), agent->policy().description().encoder.range_cap,
                 &situation_);
        situation_.pose = step.pose;
        situation_.time = step.time;
        agent->perceive(situation_);
      });
      time->drive.measure([&] { agent->decide(); });
      time->roll_out.measure([&] {
        rollOut(agent->situation(), agent->decision(), agent->shield(), drive_.goal, parameters_, rollout_, &plan_);
      });
      time->poses.measure([&] { toStampedPoses(plan_, {1.0, 2.0, 0.5}, &poses_); });
      benchmark::DoNotOptimize(poses_.data());
      benchmark::ClobberMemory();
    });
    const Decision& decision = agent->decision();
    time->decides = decision.step != last_step || distanceBetween(decision.waypoint, last_waypoint) > 0.0;
  }

  const RecordedDrive& drive_;
  AgentParameters parameters_;
  RolloutParameters rollout_;
  Situation situation_;
  std::vector<Pose2> plan_;
  std::vector<StampedPose> poses_;
  std::vector<char> others_;  ///< what other programs would have in the caches
  std::vector<CallTime> calls_;
};

std::vector<double> valuesOf(const std::vector<CallTime>& calls, bool decides, LeastTime CallTime::*part) {
  std::vector<double> values;
  for (const CallTime& call : calls) {
    if (call.decides == decides) values.push_back((call.*part).microseconds());
  }
  return values;
}

void report(const std::vector<CallTime>& calls, benchmark::State* state) {
  const std::vector<double> decisions = valuesOf(calls, true, &CallTime::whole);
  const std::vector<double> holds = valuesOf(calls, false, &CallTime::whole);
  auto& counters = state->counters;
  counters["decisions"] = static_cast<double>(decisions.size());
  counters["median_us"] = quantile(decisions, 0.5);
  counters["mean_us"] = meanOf(decisions);
  counters["p99_us"] = quantile(decisions, 0.99);
  counters["worst_us"] = quantile(decisions, 1.0);
  counters["hold_median_us"] = quantile(holds, 0.5);
  counters["hold_p99_us"] = quantile(holds, 0.99);
  counters["look_us"] = meanOf(valuesOf(calls, true, &CallTime::look));
  counters["drive_us"] = meanOf(valuesOf(calls, true, &CallTime::drive));
  counters["roll_out_us"] = meanOf(valuesOf(calls, true, &CallTime::roll_out));
  counters["poses_us"] = meanOf(valuesOf(calls, true, &CallTime::poses));
}

/// Bytes of the heap that are in use.
double heapInUse() {
#if defined(__GLIBC_PREREQ) && __GLIBC_PREREQ(2, 33)
  const auto info = mallinfo2();
#else
  const auto info = mallinfo();
#endif
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// From a scan of 1081 beams to a plan, without ROS. A call after which another decision holds than before is a
/// decision; `hold_...` are the others. The parts (look, drive, roll_out, poses) are means of the decisions. The first
/// call of a drive forgets all that was seen in the one before; it is left out. Cold: with caches that other programs
/// have used since the last call. agent_bytes: what the agent holds of the heap after the drives.
void plan(benchmark::State& state, int rollout_steps, bool cold, const std::string& world,
          Leader leader = Leader::kRoute) {
  std::vector<Replay> replays;
  for (const RecordedDrive& drive : recordedDrives()) {
    if (world.empty() || drive.world == world) replays.emplace_back(drive, rollout_steps, cold);
  }
  AgentParameters parameters;
  parameters.leader = leader;
  auto agent = std::make_unique<NavigationAgent>(shippedPolicy(), parameters);
  for (auto _ : state) {
    for (Replay& replay : replays) replay.run(agent.get());
  }
  const double with_agent = heapInUse();
  agent.reset();
  state.counters["agent_bytes"] = with_agent - heapInUse();
  std::vector<CallTime> calls;
  for (const Replay& replay : replays) calls.insert(calls.end(), replay.calls().begin() + 1, replay.calls().end());
  report(calls, &state);
}
BENCHMARK_CAPTURE(plan, decision, kDecision, false, "")->Iterations(kPasses)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, makePlan, kMakePlan, false, "")->Iterations(kPasses)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, makePlan_cold, kMakePlan, true, "")->Iterations(kPasses)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, makePlan_office, kMakePlan, false, "office")
    ->Iterations(kPasses)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, network, kMakePlan, false, "", Leader::kNetwork)
    ->Iterations(kPasses)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, network_office, kMakePlan, false, "office", Leader::kNetwork)
    ->Iterations(kPasses)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, network_building, kMakePlan, false, "building", Leader::kNetwork)
    ->Iterations(kPasses)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, makePlan_maze, kMakePlan, false, "maze")->Iterations(kPasses)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, makePlan_building, kMakePlan, false, "building")
    ->Iterations(kPasses)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lstm_planner::decision_bench
