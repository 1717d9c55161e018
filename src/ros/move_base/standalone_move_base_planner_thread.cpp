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
    if (made_) made_->is_to_goal = false;
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
  ++stops_;
  running_ = false;
  made_.reset();
}

std::optional<MadePlan> PlannerThread::takePlan() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(made_, std::nullopt);
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

}  // namespace lstm_planner
