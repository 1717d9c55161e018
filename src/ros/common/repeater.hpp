#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace lstm_planner {

/// Does something again and again in a thread of its own, with a pause before each time, until it is destroyed.
class Repeater {
 public:
  /// `work` must not throw.
  Repeater(std::chrono::milliseconds pause, const std::function<void()>& work)
      : thread_([this, pause, work] { repeat(pause, work); }) {}

  ~Repeater() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      finished_ = true;
    }
    finishes_.notify_all();
    thread_.join();
  }

 private:
  void repeat(std::chrono::milliseconds pause, const std::function<void()>& work) {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!finishes_.wait_for(lock, pause, [this] { return finished_; })) {
      lock.unlock();
      work();
      lock.lock();
    }
  }

  std::mutex mutex_;  ///< guards finished_
  std::condition_variable finishes_;
  bool finished_ = false;
  std::thread thread_;  ///< last: it uses what is above
};

}  // namespace lstm_planner
