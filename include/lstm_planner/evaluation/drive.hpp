#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lstm_planner/agent/motion_controller.hpp"
#include "lstm_planner/agent/navigation_agent.hpp"
#include "lstm_planner/agent/rollout.hpp"
#include "lstm_planner/evaluation/simulated_robot.hpp"

namespace lstm_planner {

/// One way from a start to a goal, both in the world frame.
struct DriveTask {
  Pose2 start;
  Point2 goal;
  double shortest = 0.0;  ///< m, shortest way of the footprint; 0 = not known
};

/// How a drive is run and judged.
struct DriveParameters {
  SimulatedRobot::Parameters robot;
  MotionParameters motion;
  RolloutParameters rollout;
  double control_period = 0.1;  ///< s between commands, as the Create driver's loop
  int plan_every = 2;           ///< commands between plans
  double time_limit = 1800.0;   ///< s
  double goal_radius = 0.3;     ///< m between true position and goal to count as arrival
};

/// What happened.
struct DriveResult {
  enum class End { kReached, kTimeout, kNoWay };
  End end = End::kTimeout;
  int contacts = 0;
  double time = 0.0;         ///< s
  double path_length = 0.0;  ///< m
  double shortest = 0.0;     ///< m, of the task
  long steps = 0;
  long escape_steps = 0;       ///< steps that the escape decided
  std::vector<Pose2> trace;    ///< true poses, one a command
  std::vector<char> escaping;  ///< whether the escape decided, one a pose of the trace
};

/// Drives one task with agent and controller in closed loop, without ROS. The agent is given the goal anew.
DriveResult drive(const World& world, const DriveTask& task, const DriveParameters& parameters, std::uint64_t seed,
                  NavigationAgent* agent);

/// Totals over many drives; ratios are path / shortest of those that arrived.
struct DriveSummary {
  int goals = 0;
  int reached = 0;
  int contacts = 0;
  int no_way = 0;
  int timeouts = 0;
  double mean_ratio = 0.0;
  double p95_ratio = 0.0;
  double mean_time = 0.0;  ///< s, of those that arrived
};
DriveSummary summarize(const std::vector<DriveResult>& results);

/// Random starts and goals which a disc of `footprint_radius` + `clearance` (m) can reach from one another, at least
/// `shortest` metres of way apart; the same for the same seed. Throws std::invalid_argument when the map has none.
std::vector<DriveTask> drawTasks(const GridWorld& world, int count, double footprint_radius, double clearance,
                                 double shortest, std::uint64_t seed);

}  // namespace lstm_planner
