#pragma once

#include <algorithm>
#include <cstdint>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/drive/decision/closed_loop.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/simulation/contact_count.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// Under which conditions a robot practises: they differ from robot to robot and from drive to drive.
struct PracticeConditions {
  HokuyoParameters scanner;   ///< with few beams: the means of the sectors hardly change
  double period = 0.5;        ///< s between scans, and steps
  double speed = 0.3;         ///< m/s
  double latency = 0.0;       ///< s from a decision to the wheels; until then the last command stays
  double travel_error = 0.0;  ///< of the odometry, relative
  double turn_error = 0.0;    ///< of the odometry, rad a metre
  double slip = 0.0;          ///< relative standard deviation of the true length and turn of each motion
};

/// The conditions without any randomness but the scanner's: a Create 2 with every eighth beam of a UTM-30LX.
PracticeConditions usualConditions();

/// Random conditions around the usual ones (domain randomisation: Tobin et al., "Domain randomization for transferring
/// deep neural networks from simulation to the real world", IROS 2017).
PracticeConditions drawConditions(Random& random);

/// The agent that practises: network and shield, without boundary following or memory of obstacles.
AgentParameters practiceAgent(const PolicyDescription& policy);

/// An agent with these parameters for a robot of the radius that practises (kPracticeRadius), and with a random step
/// length around the policy's.
NavigationAgent drawRobot(AgentParameters agent, PolicyDescription policy, const LayerStack& layers, Random& random);

/// Simulates a drive for practice, in the closed loop in which drive() judges what was learned: a scan and a decision a
/// step, and in between the robot turns and drives as the controller would, but without controller, plan and wheels.
class StepSimulator : private LoopRobot {
 public:
  /// `world` must outlive it. The same for the same seed.
  StepSimulator(const World& world, const DriveTask& task, const PracticeConditions& conditions, std::uint64_t seed);

  /// Gives the agent the goal, and drives until it has arrived by its odometry, gives up, or has made max_steps steps.
  LoopEnd run(int max_steps, NavigationAgent* agent);

  const Pose2& truePose() const { return pose_; }  ///< world frame; known to teachers only
  int contacts() const { return contacts_.contacts(); }
  double pathLength() const { return path_length_; }  ///< m
  /// Of a drive that arrived: best / driven path, at most 1.
  double efficiency() const { return task_.shortest / std::max(task_.shortest, path_length_); }

 private:
  bool sense(double range_cap, Situation* situation) override;
  void carryOut(const Situation& situation, const Decision& decision, const NavigationAgent& agent) override;
  bool hasArrived(const Situation& situation, const Point2& end) const override;
  Twist2 steer(const Decision& decision, const NavigationAgent& agent, double period) const;
  void move(const Twist2& twist, double seconds);

  const World& world_;
  DriveTask task_;
  PracticeConditions conditions_;
  Random random_;
  Hokuyo scanner_;
  LaserScan scan_;
  Pose2 pose_;
  Pose2 odometry_;
  Twist2 twist_;
  double time_ = 0.0;  ///< s
  ContactCount contacts_;
  double path_length_ = 0.0;
};

}  // namespace lstm_planner
