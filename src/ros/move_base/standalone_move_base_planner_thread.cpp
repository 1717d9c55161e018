#include "ros/move_base/standalone_move_base_planner_thread.hpp"

#include <chrono>
#include <utility>

namespace lstm_planner {
namespace {

// A planner that fails without a frequency is asked again at this rate, not in a tight loop.
constexpr double kRetryFrequency = 10.0;  // Hz

// Simulated time may run at any speed or stand still, so it is looked at rather than waited for.
constexpr std::chrono::milliseconds kClockPoll(5);

}  // namespace

PlannerThread::PlannerThread(MakePlan make_plan, double frequency)
    : make_plan_(std::move(make_plan)), frequency_(frequency), thread_(&PlannerThread::run, this) {}

PlannerThread::~PlannerThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    finished_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PlannerThread::start(const geometry_msgs::PoseStamped& goal) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    goal_ = goal;
    ++goal_number_;
    have_plan_ = false;
    failures_ = 0;
    running_ = true;
    due_at_once_ = true;
  }
  changed_.notify_all();
}

void PlannerThread::request() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    failures_ = 0;
    running_ = true;
    due_at_once_ = true;
  }
  changed_.notify_all();
}

void PlannerThread::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++goal_number_;
  running_ = false;
  have_plan_ = false;
}

bool PlannerThread::takePlan(Plan& plan) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!have_plan_) return false;
  have_plan_ = false;
  plan = std::move(plan_);
  return true;
}

int PlannerThread::failures() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failures_;
}

ros::Duration PlannerThread::period() const {
  return ros::Duration(1.0 / (frequency_ > 0.0 ? frequency_ : kRetryFrequency));
}

bool PlannerThread::waitUntilDue(std::unique_lock<std::mutex>& lock) {
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

void PlannerThread::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (waitUntilDue(lock)) {
    const std::uint64_t goal_number = goal_number_;
    const geometry_msgs::PoseStamped goal = goal_;
    lock.unlock();
    Plan plan;
    const bool made = make_plan_(goal, plan);
    lock.lock();
    if (goal_number != goal_number_) continue;
    if (!made) {
      ++failures_;
      continue;
    }
    failures_ = 0;
    plan_ = std::move(plan);
    have_plan_ = true;
    if (frequency_ <= 0.0 && !due_at_once_) running_ = false;
  }
}

}  // namespace lstm_planner
