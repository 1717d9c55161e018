#pragma once

#include "lstm_planner/robot/driving/navigation_agent.hpp"
#include "lstm_planner/robot/perception/laser_scan.hpp"
#include "lstm_planner/robot/perception/scan_rules.hpp"

namespace lstm_planner {

/// Feeds a NavigationAgent with scans and with a goal that may be given anew or move: what the planner in a robot and
/// the replay of a recording have in common. Poses and goals are in the odometry frame. Not thread safe.
class OnlineAgent {
 public:
  /// Why the way so far was forgotten.
  enum class Fresh {
    kNo,        ///< it was not
    kNewGoal,   ///< the goal was given anew
    kJump,      ///< the odometry jumped: what was seen is forgotten, too
    kGoalMoved  ///< the goal moved farther than localisation corrects while the odometry is sound
  };

  /// Throws std::invalid_argument for bad parameters or a policy that does not fit them.
  /// `rules`: what the scanner's readings mean.
  OnlineAgent(DrivePolicy policy, const AgentParameters& parameters, const ScanRules& rules);

  /// What the scanner sees at `time` (s) from `pose`. Throws UnusableScan, or std::invalid_argument when the model was
  /// made for another scanner or robot or the pose is out of reach (checkPose).
  void look(const LaserScan& scan, const SensorMount& mount, const Pose2& pose, double time);

  /// Decides about what was looked at last: decision(). `is_new`: the goal was given since the last call. `jumps`: how
  /// often the odometry has jumped so far. Throws std::invalid_argument for a goal out of reach (checkGoal).
  Fresh drive(const Point2& goal, bool is_new, long jumps);

  /// What drive() would decide for a goal that has just been set, and throw; changes nothing that it depends on.
  Decision preview(const Point2& goal) const;

  const Decision& decision() const { return agent_.decision(); }
  const Situation& situation() const { return situation_; }
  const Point2& goal() const { return agent_.goal(); }
  const Shield& shield() const { return agent_.shield(); }
  const PolicyDescription& description() const { return agent_.policy().description(); }

 private:
  NavigationAgent agent_;
  ScanRules rules_;
  Situation situation_;
  bool is_new_ = false;  ///< the goal, and nothing was decided for it
  long jumps_ = 0;       ///< that were heard of
};

}  // namespace lstm_planner
