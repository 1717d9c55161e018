#include "lstm_planner/drive/decision/closed_loop.hpp"

#include "lstm_planner/drive/decision/arrival.hpp"

namespace lstm_planner {

ClosedLoop::End ClosedLoop::run(const Point2& goal, const std::function<bool()>& goes_on,
                                const std::function<void(const Decision&)>& note) {
  const double range_cap = agent_.policy().description().encoder.range_cap;
  agent_.setGoal(goal);
  agent_.restart();  // what it remembers of another drive is in another odometry frame
  while (goes_on()) {
    if (!robot_.sense(range_cap, &situation_)) continue;
    agent_.perceive(situation_);
    const Decision& decision = agent_.decide();
    if (decision.choice == Decision::Move::kNoPath) return End::kNoPath;
    if (robot_.hasArrived(situation_, endOfPlan(decision, goal, agent_.parameters()))) return End::kArrived;
    note(decision);
    robot_.carryOut(situation_, decision, agent_);
  }
  return End::kStopped;
}

}  // namespace lstm_planner
