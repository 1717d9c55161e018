#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "ros/callback_thread.hpp"
#include "ros/fake_robot.hpp"

namespace lstm_planner {

/// What all nodes of this master log.
class LogListener {
 public:
  /// Returns when it hears this process.
  LogListener() : subscriber_(callbacks_.nodeHandle().subscribe("/rosout", 1000, &LogListener::onLog, this)) {
    EXPECT_TRUE(eventually([&] {
      ROS_INFO("is somebody listening?");
      return count("is somebody listening?") > 0;
    }));
  }

  /// Number of lines with that text so far; in it, * stands for anything, such as an age.
  int count(const std::string& text) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return static_cast<int>(
        std::count_if(lines_.begin(), lines_.end(), [&](const std::string& line) { return has(line, text); }));
  }

  /// True as soon as some node has logged that.
  bool eventuallyHas(const std::string& text) {
    return eventually([&] { return count(text) > 0; });
  }

  /// Waits until all that this process logged before has come in.
  void flush() {
    const std::string mark = "mark " + std::to_string(++marks_);
    ROS_INFO("%s", mark.c_str());
    EXPECT_TRUE(eventually([&] { return count(mark) > 0; }));
  }

  /// Expects that `ask` is refused and that this process logs why. `pass` goes before each of several attempts:
  /// messages take a while to come in, and the same line is logged every two seconds (of ros::Time) at most.
  void expectRefusal(const std::function<bool()>& ask, const std::string& reason, const std::function<void()>& pass) {
    const int before = count(reason);
    EXPECT_TRUE(eventually([&] {
      pass();
      const bool refused = !ask();
      flush();
      return refused && count(reason) > before;
    })) << "not refused because: "
        << reason << "; the last line is: " << lastLine();
  }

 private:
  void onLog(const rosgraph_msgs::Log::ConstPtr& line) {
    const std::lock_guard<std::mutex> lock(mutex_);
    lines_.push_back(line->msg);
  }

  static bool has(const std::string& line, const std::string& text) {
    std::size_t at = 0;
    for (std::size_t start = 0; start <= text.size();) {
      const std::size_t end = std::min(text.find('*', start), text.size());
      at = line.find(text.substr(start, end - start), at);
      if (at == std::string::npos) return false;
      at += end - start;
      start = end + 1;
    }
    return true;
  }

  /// The last one that is not its own.
  std::string lastLine() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto line = std::find_if(lines_.rbegin(), lines_.rend(),
                                   [](const std::string& text) { return text.compare(0, 5, "mark ") != 0; });
    return line == lines_.rend() ? "" : *line;
  }

  std::mutex mutex_;
  std::vector<std::string> lines_;
  int marks_ = 0;
  CallbackThread callbacks_;
  ros::Subscriber subscriber_;
};

}  // namespace lstm_planner
