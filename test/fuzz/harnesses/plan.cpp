#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "fuzz/fuzz_scan.hpp"
#include "fuzz/harness.hpp"
#include "fuzz/small_memory.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/drive/decision/goal_changes.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "support/agent_steps.hpp"

namespace lstm_planner::fuzz::plan_harness {
namespace {

constexpr int kMostCalls = 8;
constexpr std::array kLeaders{Leader::kNetwork, Leader::kRoute, Leader::kGreedy};

AgentParameters smallWorld(Leader leader) {
  AgentParameters parameters;
  parameters.leader = leader;
  parameters.memory = smallMemory();
  return parameters;
}

void checkPlan(const std::vector<Pose2>& plan) {
  require(plan.size() >= 2 && plan.size() <= static_cast<std::size_t>(kMostPlanPoses),
          "a plan has two poses at least, and not without bound");
  for (const Pose2& pose : plan) require(isFinite(pose), "the poses of a plan are finite");
}

/// The planner's calls while a robot stands and moves anywhere: scans, poses and goals, the last two of any size but
/// finite, as the plugin lets through.
void plan(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  const auto leader = kLeaders.at(static_cast<std::size_t>(input.integer(0, 2)));
  NavigationAgent agent(noPolicy(), smallWorld(leader));
  GoalChanges changes;
  Pose2 pose;
  Pose2 goal{3.0, 0.0, 0.0};
  double time = 1000.0;
  long jumps = 0;
  std::vector<Pose2> poses;
  for (int call = 0; call < kMostCalls && !input.empty(); ++call) {
    const int kind = input.byte();
    if ((kind & 3) == 3) pose = anyPose(&input);
    if ((kind & 4) != 0) pose = {pose.x + input.numberIn(-0.4, 0.4), pose.y + input.numberIn(-0.4, 0.4), pose.yaw};
    if ((kind & 8) != 0) goal = anyPose(&input);
    if ((kind & 16) != 0) jumps += input.byte() % 2;
    time += (kind & 32) != 0 ? input.number() : 0.2;
    if (!isFinite(pose) || !isFinite(goal)) return;
    const LaserScan scan = anyScan(&input);
    expectRefusal<std::invalid_argument>([&] {
      test::perceive(&agent, scan, anyMount(&input), pose, time);
      const bool asks = (kind & 64) != 0;
      if (!asks) changes.tell(&agent, goal, {}, (kind & 128) != 0, jumps);
      const Decision decision = asks ? agent.preview({goal.x, goal.y}) : agent.decide();
      Shield shield(Footprint(0.17425), 0.03, 6.0);
      shield.show(agent.situation().obstacles);
      rollOut(agent.situation(), decision, shield, goal, smallWorld(leader), {}, &poses);
      checkPlan(poses);
    });
  }
}

const Registration registration("plan", &plan);

}  // namespace
}  // namespace lstm_planner::fuzz::plan_harness
