#pragma once

#include <actionlib/client/simple_action_client.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/UInt32.h>

#include <functional>
#include <string>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/simulation/trace_picture.hpp"

namespace lstm_planner {

/// What `demo_runner` reads from its private namespace. The scenario (parameters below `~scenario/`) is a goals file
/// such as config/demo_goals.yaml, which explains them.
struct DemoParameters {
  /// One of the goals that are driven to in turn.
  struct Goal {
    std::string name;
    Pose2 pose;         ///< in the map frame
    double time_limit;  ///< s
  };
  std::vector<Goal> goals;  ///< ~scenario/goals
  Pose2 start;              ///< ~start, else ~scenario/start: where odometry started, in the map frame
  std::string map;
  double free_threshold = -1.0;
  std::string odom_frame = "odom";
  std::string action = "move_base";
  double robot_radius = 0.17425;
  double arrival_radius = 0.4;
  double patience = 60.0;
  std::string picture;
  std::string result;
};

/// Visits every parameter but the scenario's; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitDemoParameters(Parameters& demo, const Visitor& visit) {
  visit("map", demo.map, {}, "", "path of the map_server yaml");
  visit("free_threshold", demo.free_threshold, {-1.0, 1.0}, "", "replaces the map's free_thresh if it is not negative");
  visit("odom_frame", demo.odom_frame, {}, "", "frame in which the goals are sent");
  visit("action", demo.action, {}, "", "name of the action server");
  visit("robot_radius", demo.robot_radius, {0.02, 5.0}, "m", "radius of the footprint, to compute the shortest paths");
  visit("arrival_radius", demo.arrival_radius, {0.01, 100.0}, "m",
        "largest distance between true position and goal at an arrival");
  visit("patience", demo.patience, {0.1, 86400.0}, "s",
        "longest wait for action server or ground truth, in the computer's time");
  visit("picture", demo.picture, {}, "", "path of the picture; empty: none");
  visit("result", demo.result, {}, "", "path of the result file; empty: none");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
DemoParameters loadDemoParameters(const ros::NodeHandle& private_node);

/// What became of one goal.
struct DemoLeg {
  std::string name;
  Point2 goal;             ///< in the map frame
  bool reached = false;    ///< the action succeeded and the robot truly is there
  std::string text;        ///< what the action said, or why the arrival is not believed
  double time = 0.0;       ///< s
  double path = 0.0;       ///< m, truly driven
  double shortest = 0.0;   ///< m, shortest path of the footprint from where the leg started; +inf where there is none
  double remaining = 0.0;  ///< m to the goal at the end
  unsigned contacts = 0;
};

/// "goal 2 kitchen (3.1, 4.0): reached in 31.2 s, path 9.5 m = 1.08 x shortest, 0 contacts".
std::string describeLeg(const DemoLeg& leg);

/// One line for all legs of `planned` goals.
std::string describeDemo(const std::vector<DemoLeg>& legs, std::size_t planned);

/// 0 when every planned goal was reached and nothing was touched, else 1.
int demoExitCode(const std::vector<DemoLeg>& legs, std::size_t planned);

/// First line the exit code, then JSON: goals, reached, contacts, mean_ratio, mean_time_s, legs, error. Throws
/// std::runtime_error naming the file.
void writeDemoResult(const std::string& path, int exit_code, const std::vector<DemoLeg>& legs, std::size_t planned,
                     const std::string& error);

/// The node `demo_runner`: sends goals one after another to a move_base action and judges, from `ground_truth`
/// (nav_msgs/Odometry in the map frame) and `contacts` (std_msgs/UInt32), what the robot made of them.
class DemoRunner {
 public:
  /// Throws MapFileError, or std::invalid_argument when a goal lies outside the map.
  explicit DemoRunner(const DemoParameters& parameters);

  /// Drives to all goals, prints a line for each and a summary, leaves result file and picture. Returns the exit code.
  int run();

 private:
  using Client = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;

  void onTruth(const nav_msgs::Odometry::ConstPtr& message);
  void onContacts(const std_msgs::UInt32::ConstPtr& message);
  void driveAll();
  void waitForOthers();
  DemoLeg drive(const DemoParameters::Goal& goal);
  std::string followGoal(const DemoParameters::Goal& goal);
  bool spinUntil(double seconds, const std::function<bool()>& condition);
  void checkAlive() const;
  move_base_msgs::MoveBaseGoal message(const Pose2& goal) const;
  double shortestPath(const Point2& goal) const;
  void drawPicture() const;

  DemoParameters parameters_;
  OccupancyGrid map_;
  DistanceField distances_;
  std::vector<DemoLeg> legs_;

  Pose2 pose_;       ///< true, in the map frame
  ros::Time stamp_;  ///< of pose_; zero before the first
  ros::WallTime last_heard_;
  double driven_ = 0.0;  ///< m since the start
  unsigned contacts_ = 0;
  std::vector<Point2> trace_;
  std::vector<Point2> contact_points_;

  ros::NodeHandle node_;
  ros::Subscriber truth_subscriber_;
  ros::Subscriber contacts_subscriber_;
  Client client_;
};

}  // namespace lstm_planner
