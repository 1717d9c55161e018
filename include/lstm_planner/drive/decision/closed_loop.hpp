#pragma once

#include <functional>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"

namespace lstm_planner {

/// A robot in a simulated world, as the closed loop sees it.
class LoopRobot {
 public:
  virtual ~LoopRobot() = default;

  /// What it sees from where it is; `situation` is in the odometry frame and is overwritten. False when a scan cannot
  /// be used: the robot has stood for a moment instead.
  virtual bool sense(double range_cap, Situation* situation) = 0;

  /// Drives as was decided until the agent is to look again. `agent` has perceived the situation.
  virtual void carryOut(const Situation& situation, const Decision& decision, const NavigationAgent& agent) = 0;

  /// Whether it says itself that it has arrived at the end of its plan (odometry frame).
  virtual bool hasArrived(const Situation& situation, const Point2& end) const = 0;
};

/// Why a drive ended.
enum class LoopEnd {
  kArrived,  ///< the robot says so
  kNoPath,   ///< the agent says that there is none
  kStopped   ///< `goes_on` said so
};

/// Sense, decide, drive, sense again: the loop in which networks practise and in which they are judged. What happens
/// between two looks depends on the robot: a simulated Create 2 obeys the controller's commands (drive()); a robot that
/// practises (StepSimulator) moves directly to where the controller would lead it, which is many times as fast.
///
/// Gives the agent the goal (odometry frame), which forgets all that it knew. Asks `goes_on` before each look and calls
/// `note` with each decision before it is carried out.
LoopEnd runClosedLoop(const Point2& goal, LoopRobot* robot, NavigationAgent* agent,
                      const std::function<bool()>& goes_on, const std::function<void(const Decision&)>& note);

}  // namespace lstm_planner
