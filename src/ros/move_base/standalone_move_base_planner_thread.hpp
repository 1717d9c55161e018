#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/time.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "ros/move_base/standalone_move_base_plugins.hpp"

namespace lstm_planner {

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

  /// Plans to this goal from now on; what is being made for an earlier goal is discarded.
  void start(const geometry_msgs::PoseStamped& goal);

  /// A plan to the same goal is needed at once.
  void request();

  void stop();

  /// The newest plan, once; false when there is none since the last call.
  bool takePlan(Plan& plan);

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
  bool have_plan_ = false;
  int failures_ = 0;
  std::uint64_t goal_number_ = 0;
  ros::Time last_start_;
  geometry_msgs::PoseStamped goal_;
  Plan plan_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace lstm_planner
