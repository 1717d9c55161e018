#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/time.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "ros/move_base/standalone_move_base_plugins.hpp"

namespace lstm_planner {

/// A plan, and whether it leads to the present goal or to the one before.
struct MadePlan {
  Plan plan;
  bool is_to_goal = false;
};

/// Makes plans to a goal in a thread of its own, at a rate or on request.
class PlannerThread {
 public:
  /// Makes a plan to the goal; called from the thread alone, must not throw.
  using MakePlan = std::function<bool(const geometry_msgs::PoseStamped& goal, Plan& plan)>;

  /// `frequency`: plans a second (ROS time); 0 makes one when asked and repeats it until it succeeds.
  PlannerThread(MakePlan make_plan, double frequency);

  /// Waits for the plan that is being made.
  ~PlannerThread();

  PlannerThread(const PlannerThread&) = delete;
  PlannerThread& operator=(const PlannerThread&) = delete;

  /// Plans to this goal from now on. Until stop(), the newest plan to an earlier goal remains: where goals come faster
  /// than plans, the robot would never have one.
  void start(const geometry_msgs::PoseStamped& goal);

  /// A plan to the same goal is needed at once.
  void request();

  /// No more plans; those to the goals until now are discarded.
  void stop();

  /// The newest plan, once; none when there is none since the last call.
  std::optional<MadePlan> takePlan();

  /// Failures since the last plan, start() or request().
  int failures() const;

 private:
  void run();
  bool waitUntilDue(std::unique_lock<std::mutex>& lock);
  ros::Duration period() const;

  const MakePlan make_plan_;
  const double frequency_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool finished_ = false;
  bool running_ = false;
  bool due_at_once_ = false;
  int failures_ = 0;
  std::uint64_t goal_number_ = 0;
  std::uint64_t stops_ = 0;
  ros::Time last_start_;
  geometry_msgs::PoseStamped goal_;
  std::optional<MadePlan> made_;  ///< not taken yet
  std::thread thread_;            // last: it uses all of the above
};

}  // namespace lstm_planner
