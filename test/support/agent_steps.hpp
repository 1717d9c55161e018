#pragma once

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner::test {

/// Shows an agent what a scanner sees at that time (s) from that pose.
inline void perceive(NavigationAgent* agent, const LaserScan& scan, const SensorMount& mount, const Pose2& pose,
                     double time, const ScanRules& rules = {}) {
  Situation situation;
  lstm_planner::perceive(scan, mount, rules, agent->policy().description().encoder.range_cap, &situation);
  situation.pose = pose;
  situation.time = time;
  agent->perceive(situation);
}

/// What it decides there.
inline Decision decideIn(const Situation& situation, NavigationAgent* agent) {
  agent->perceive(situation);
  return agent->decide();
}

/// What it would decide there about a goal that has just been set.
inline Decision previewIn(const Situation& situation, const Point2& goal, NavigationAgent agent) {
  agent.perceive(situation);
  return agent.preview(goal);
}

}  // namespace lstm_planner::test
