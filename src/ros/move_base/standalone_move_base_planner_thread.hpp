#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/time.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

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
  PlannerThread(MakePlan make_plan, double frequency)
      : make_plan_(std::move(make_plan)), frequency_(frequency), thread_(&PlannerThread::run, this) {}

  /// Waits for the plan that is being made.
  ~PlannerThread() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      finished_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  PlannerThread(const PlannerThread&) = delete;
  PlannerThread& operator=(const PlannerThread&) = delete;

  /// Plans to this goal from now on. Until stop(), the newest plan to an earlier goal remains: where goals come faster
  /// than plans, the robot would never have one.
  void start(const geometry_msgs::PoseStamped& goal) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      goal_ = goal;
      ++goal_number_;
      if (made_) made_->is_to_goal = false;
      failures_ = 0;
      running_ = true;
      due_at_once_ = true;
    }
    changed_.notify_all();
  }

  /// A plan to the same goal is needed at once.
  void request() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      failures_ = 0;
      running_ = true;
      due_at_once_ = true;
    }
    changed_.notify_all();
  }

  /// No more plans; those to the goals until now are discarded.
  void stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++stops_;
    running_ = false;
    made_.reset();
  }

  /// The newest plan, once; none when there is none since the last call.
  std::optional<MadePlan> takePlan() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(made_, std::nullopt);
  }

  /// Failures since the last plan, start() or request().
  int failures() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return failures_;
  }

 private:
  // A planner that fails without a frequency is asked again at this rate, not in a tight loop.
  static constexpr double kRetryFrequency = 10.0;  // Hz

  // Simulated time may run at any speed or stand still, so it is looked at rather than waited for.
  static constexpr std::chrono::milliseconds kClockPoll{5};

  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (waitUntilDue(lock)) {
      const std::uint64_t goal_number = goal_number_;
      const std::uint64_t stops = stops_;
      const geometry_msgs::PoseStamped goal = goal_;
      lock.unlock();
      MadePlan made;
      const bool is_made = make_plan_(goal, made.plan);
      lock.lock();
      if (stops != stops_) continue;
      made.is_to_goal = goal_number == goal_number_;
      if (made.is_to_goal) failures_ = is_made ? 0 : failures_ + 1;
      if (!is_made) continue;
      made_ = std::move(made);
      if (frequency_ <= 0.0 && !due_at_once_) running_ = false;
    }
  }
  bool waitUntilDue(std::unique_lock<std::mutex>& lock) {
    while (!finished_) {
      if (!running_) {
        changed_.wait(lock);
        continue;
      }
      const ros::Time now = ros::Time::now();
      // A clock set back, as by a restarted simulation, must not hold the planner up until it has caught up.
      const bool due = due_at_once_ || now < last_start_ || now - last_start_ >= period();
      if (due) {
        due_at_once_ = false;
        last_start_ = now;
        return true;
      }
      const ros::Duration left = last_start_ + period() - now;
      changed_.wait_for(lock, ros::Time::isSimTime() ? kClockPoll : std::chrono::nanoseconds(left.toNSec()));
    }
    return false;
  }
  ros::Duration period() const { return ros::Duration(1.0 / (frequency_ > 0.0 ? frequency_ : kRetryFrequency)); }

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
