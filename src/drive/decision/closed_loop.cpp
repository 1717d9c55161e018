#include "lstm_planner/drive/decision/closed_loop.hpp"

#include "lstm_planner/drive/decision/arrival.hpp"

namespace lstm_planner {

LoopEnd runClosedLoop(const Point2& goal, LoopRobot* robot, NavigationAgent* agent,
                      const std::function<bool()>& goes_on, const std::function<void(const Decision&)>& note) {
  const double range_cap = agent->policy().description().encoder.range_cap;
  Situation situation;
  agent->setGoal(goal);
  agent->restart();  // what it remembers of another drive is in another odometry frame
  while (goes_on()) {
    if (!robot->sense(range_cap, &situation)) continue;
    agent->perceive(situation);
    const Decision& decision = agent->decide();
    if (decision.choice == Decision::Move::kNoPath) return LoopEnd::kNoPath;
    if (robot->hasArrived(situation, endOfPlan(decision, goal, agent->parameters()))) return LoopEnd::kArrived;
    note(decision);
    robot->carryOut(situation, decision, *agent);
  }
  return LoopEnd::kStopped;
}

}  // namespace lstm_planner
