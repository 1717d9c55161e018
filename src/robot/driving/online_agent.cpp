#include "lstm_planner/robot/driving/online_agent.hpp"

#include <utility>

#include "robot/perception/reach.hpp"

namespace lstm_planner {

OnlineAgent::OnlineAgent(DrivePolicy policy, const AgentParameters& parameters, const ScanRules& rules)
    : agent_(std::move(policy), parameters), rules_((validate(rules), rules)) {}

void OnlineAgent::look(const LaserScan& scan, const SensorMount& mount, const Pose2& pose, double time) {
  const AgentParameters& parameters = agent_.parameters();
  checkPose(pose);
  checkFits(description(), parameters.step.length, parameters.shield.footprint_radius, scan.range_max);
  perceive(scan, mount, rules_, description().encoder.range_cap, &situation_);
  situation_.pose = pose;
  situation_.time = time;
}

OnlineAgent::Fresh OnlineAgent::drive(const Point2& goal, bool is_new, long jumps) {
  constexpr double kGoalShift = 0.25;  // m
  is_new_ = is_new_ || is_new;
  checkGoal(situation_.pose, goal);
  const double shift = distanceBetween(agent_.goal(), goal);
  const bool jumped = jumps != jumps_;
  Fresh fresh = Fresh::kNo;
  if (is_new_) {
    fresh = Fresh::kNewGoal;
  } else if (jumped) {
    fresh = Fresh::kJump;
  } else if (shift > kGoalShift) {
    fresh = Fresh::kGoalMoved;
  }
  if (fresh != Fresh::kNo) {
    agent_.setGoal(goal);
  } else if (shift > 0.0) {
    agent_.moveGoal(goal);
  }
  if (jumped) {
    agent_.restart();
    jumps_ = jumps;
  }
  is_new_ = false;
  agent_.update(situation_);
  return fresh;
}

Decision OnlineAgent::preview(const Point2& goal) const {
  checkGoal(situation_.pose, goal);
  return agent_.preview(situation_, goal);
}

}  // namespace lstm_planner
