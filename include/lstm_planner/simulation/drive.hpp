#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "lstm_planner/simulation/simulated_robot.hpp"

namespace lstm_planner {

/// One path from a start to a goal, both in the world frame.
struct DriveTask {
  Pose2 start;
  Point2 goal;
  double shortest = 0.0;  ///< m, shortest path of the footprint; 0 = not known
};

/// Who decides that the robot has arrived.
enum class Arrival {
  /// The robot, as in a building: its controller is within its tolerance of the goal, as far as it knows. The distance
  /// of the true position may be larger by the error of the robot's pose; after a contact, when wheels may have
  /// slipped, by the odometry's error times the driven path. If the goal seems to lie in an obstacle, a place beside
  /// it, at most that far away, replaces it.
  kRobotSays,
  /// The true position (BARN): the drive ends there. It also ends if the robot says that it has arrived.
  kTruePosition
};

/// How a drive is run and judged.
struct DriveParameters {
  SimulatedRobot::Parameters robot;
  MotionParameters motion;
  RolloutParameters rollout;
  double time_limit = 1800.0;  ///< s
  double goal_radius = 0.3;    ///< m between true position and goal to count as arrival
  Arrival arrival = Arrival::kRobotSays;
  bool ends_at_touch = false;  ///< ends at the first contact, or when the first body runs into the robot
};

/// A moment of a drive: a command was given, and nothing has moved since.
struct DriveMoment {
  double time;                     ///< s since the start
  Pose2 pose;                      ///< true pose of the robot, world frame
  const Situation& situation;      ///< what the robot knows, agent's frame
  const std::vector<Pose2>& plan;  ///< the plan that the controller follows, agent's frame
  const NavigationAgent& agent;    ///< after its decision
};
using DriveListener = std::function<void(const DriveMoment&)>;

/// Result of a drive.
struct DriveResult {
  /// How the drive ended.
  enum class End {
    kReached,    ///< within the tolerance of the goal
    kTimeout,    ///< the time limit passed
    kNoPath,     ///< the robot said that there is no path
    kElsewhere,  ///< the robot said that it had arrived, but it had not
    kTouched,    ///< it touched something, or was run into (DriveParameters::ends_at_touch)
    kStuck       ///< the controller gave up (StopReason::kStuck) for MotionParameters::patience: move_base would abort
  };
  End end = End::kTimeout;
  int contacts = 0;          ///< caused by the robot, see SimulatedRobot
  int bumped = 0;            ///< people who ran into it
  int bumped_moving = 0;     ///< of those, while it moved aside or away from them
  double time = 0.0;         ///< s
  double path_length = 0.0;  ///< m
  double shortest = 0.0;     ///< m, of the task
  double goal_error = 0.0;   ///< m from the true position to the goal at the end
  /// The first value other than kReachable that the robot gave; kReachable if it gave none.
  Decision::GoalSeems goal_seemed = Decision::GoalSeems::kReachable;
  long steps = 0;
  std::array<long, kChoices.size()> steps_by{};   ///< of these, one of kChoices each
  long steps_on_path = 0;                         ///< of these, decided by the leader along the remembered path
  std::array<long, kOverruledKinds> overruled{};  ///< steps by Overruled
  double regret = 0.0;                            ///< m, Decision::regret_used at the end
  std::vector<Pose2> trace;                       ///< true poses, world frame, one for each command
  std::vector<Decision::Choice> led;              ///< who decided, one for each pose of the trace
  std::vector<char> on_path;                      ///< whether along the remembered path, one for each pose of the trace
  std::vector<Point2> contact_places;             ///< where the robot was, world frame
  std::vector<std::vector<Point2>> walker_traces;  ///< by walker, one place for each pose of the trace
};

/// Share of the steps of all drives with this choice.
double shareOf(Decision::Choice choice, const std::vector<DriveResult>& results);
/// Share of the steps of all drives in which the leader was overruled in this way.
double shareOf(Overruled overruled, const std::vector<DriveResult>& results);
/// Share of the steps with this choice among those without the goal in sight.
double shareOutOfSight(Decision::Choice choice, const std::vector<DriveResult>& results);
/// Share of the steps that the leader decided along the remembered path.
double shareOnPath(const std::vector<DriveResult>& results);

/// Drives one task with agent and controller in closed loop, without ROS. The agent gets the goal as a new one.
/// `listener`, if there is one, is called at every moment.
DriveResult drive(const World& world, const DriveTask& task, const DriveParameters& parameters, std::uint64_t seed,
                  NavigationAgent* agent, const DriveListener& listener = {});
/// The same among bodies that move; they start where they are now.
DriveResult drive(Traffic* traffic, const DriveTask& task, const DriveParameters& parameters, std::uint64_t seed,
                  NavigationAgent* agent, const DriveListener& listener = {});

/// Totals over many drives; ratios are path / shortest of those that arrived. Means are 0 if none arrived.
struct DriveSummary {
  int goals = 0;
  int reached = 0;
  int contacts = 0;
  int bumped = 0;
  int bumped_moving = 0;
  int no_path = 0;
  int timeouts = 0;
  int elsewhere = 0;
  int touched = 0;  ///< drives that ended with a touch
  int stuck = 0;    ///< drives that ended stuck
  double mean_ratio = 0.0;
  double p95_ratio = 0.0;
  double mean_time = 0.0;        ///< s, of those that arrived
  double mean_goal_error = 0.0;  ///< m, of those that arrived
};
DriveSummary summarize(const std::vector<DriveResult>& results);

/// Random starts and goals on free cells, between which a disc of `footprint_radius` + `clearance` (m) has a path of at
/// least `shortest` (m); the same for the same seed. Throws std::invalid_argument if the map has none.
std::vector<DriveTask> drawTasks(const GridWorld& world, int count, double footprint_radius, double clearance,
                                 double shortest, std::uint64_t seed);

}  // namespace lstm_planner
