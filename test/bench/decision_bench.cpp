#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lstm_planner/agent/online_agent.hpp"
#include "lstm_planner/agent/rollout.hpp"
#include "recorded_steps.hpp"

namespace lstm_planner {
namespace {

using Clock = std::chrono::steady_clock;

double microseconds(Clock::duration duration) { return std::chrono::duration<double, std::micro>(duration).count(); }

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

/// Where the time of a call goes, us. Of several calls that did the same: the least of each.
struct CallTime {
  double look = std::numeric_limits<double>::infinity();
  double drive = look;
  double roll_out = look;
  double poses = look;
  double whole = look;
  bool decides = false;  ///< rather than that the last decision still holds
};

/// The same drives again and again: what other programs on the machine do to one call they hardly do to it each time.
class Replay {
 public:
  explicit Replay(const RecordedDrive& drive, int rollout_steps) : drive_(drive), calls_(drive.steps.size()) {
    rollout_.steps = rollout_steps;
  }

  /// `pass`: the how manieth replay by this agent.
  void run(long pass, OnlineAgent* agent) {
    for (std::size_t i = 0; i < drive_.steps.size(); ++i) {
      call(drive_.steps[i], i == 0, pass, agent, &calls_[i]);
    }
  }

  const std::vector<CallTime>& calls() const { return calls_; }

 private:
  void call(const RecordedStep& step, bool is_new, long pass, OnlineAgent* agent, CallTime* time) {
    const long last_step = is_new ? 0 : agent->decision().step;
    const Point2 last_waypoint = agent->decision().waypoint;
    const Clock::time_point begin = Clock::now();
    agent->look(step.scan, drive_.mount, step.pose, step.time);
    const Clock::time_point looked = Clock::now();
    agent->drive({drive_.goal.x, drive_.goal.y}, is_new, pass);
    const Clock::time_point driven = Clock::now();
    rollOut(agent->situation(), agent->decision(), agent->shield(), drive_.goal, AgentParameters(), rollout_, &plan_);
    const Clock::time_point rolled = Clock::now();
    toStampedPoses(plan_, {1.0, 2.0, 0.5}, &poses_);
    benchmark::DoNotOptimize(poses_.data());
    benchmark::ClobberMemory();
    const Clock::time_point end = Clock::now();

    time->look = std::min(time->look, microseconds(looked - begin));
    time->drive = std::min(time->drive, microseconds(driven - looked));
    time->roll_out = std::min(time->roll_out, microseconds(rolled - driven));
    time->poses = std::min(time->poses, microseconds(end - rolled));
    time->whole = std::min(time->whole, microseconds(end - begin));
    time->decides =
        agent->decision().step != last_step || distanceBetween(agent->decision().waypoint, last_waypoint) > 0.0;
  }

  const RecordedDrive& drive_;
  RolloutParameters rollout_;
  std::vector<Pose2> plan_;
  std::vector<StampedPose> poses_;
  std::vector<CallTime> calls_;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::vector<double> valuesOf(const std::vector<CallTime>& calls, bool decides, double CallTime::*part) {
  std::vector<double> values;
  for (const CallTime& call : calls) {
    if (call.decides == decides) values.push_back(call.*part);
  }
  return values;
}

void report(const std::vector<CallTime>& calls, benchmark::State* state) {
  const std::vector<double> decisions = valuesOf(calls, true, &CallTime::whole);
  const std::vector<double> holds = valuesOf(calls, false, &CallTime::whole);
  auto& counters = state->counters;
  counters["decisions"] = static_cast<double>(decisions.size());
  counters["median_us"] = quantile(decisions, 0.5);
  counters["mean_us"] = mean(decisions);
  counters["p99_us"] = quantile(decisions, 0.99);
  counters["worst_us"] = quantile(decisions, 1.0);
  counters["hold_median_us"] = quantile(holds, 0.5);
  counters["hold_p99_us"] = quantile(holds, 0.99);
  counters["look_us"] = mean(valuesOf(calls, true, &CallTime::look));
  counters["drive_us"] = mean(valuesOf(calls, true, &CallTime::drive));
  counters["roll_out_us"] = mean(valuesOf(calls, true, &CallTime::roll_out));
  counters["poses_us"] = mean(valuesOf(calls, true, &CallTime::poses));
}

/// From a scan of 1081 beams to a plan, without ROS. A call after which another decision holds than before is a
/// decision; `hold_...` are the others. The parts (look, drive, roll_out, poses) are means of the decisions. The first
/// call of a drive forgets all that was seen before, and is left out.
void plan(benchmark::State& state, int world, int rollout_steps) {
  static const std::vector<RecordedDrive> drives = recordDrives();
  std::vector<Replay> replays;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (world < 0 || static_cast<int>(i) == world) replays.emplace_back(drives[i], rollout_steps);
  }
  OnlineAgent agent(shippedPolicy(), {});
  long pass = 0;
  for (auto _ : state) {
    for (Replay& replay : replays) replay.run(++pass, &agent);
  }
  std::vector<CallTime> calls;
  for (const Replay& replay : replays) calls.insert(calls.end(), replay.calls().begin() + 1, replay.calls().end());
  report(calls, &state);
}
constexpr int kPasses = 20;
constexpr int kDecision = 1;  // steps of the rollout
constexpr int kMakePlan = 10;
BENCHMARK_CAPTURE(plan, decision, -1, kDecision)->Iterations(kPasses)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, makePlan, -1, kMakePlan)->Iterations(kPasses)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, makePlan_office, 0, kMakePlan)->Iterations(kPasses)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, makePlan_maze, 1, kMakePlan)->Iterations(kPasses)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, makePlan_building, 2, kMakePlan)->Iterations(kPasses)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lstm_planner
