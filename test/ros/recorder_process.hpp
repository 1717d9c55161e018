#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "ros/callback_thread.hpp"
#include "ros/fake_robot.hpp"

namespace lstm_planner {

/// The node dataset_recorder as a process of its own, so that it can be stopped in every way there is.
class RecorderProcess {
 public:
  /// `name`: the node's. `arguments`: "_period:=0.5". What it prints goes into the file `log`.
  RecorderProcess(const std::string& name, const std::string& log, const std::vector<std::string>& arguments)
      : log_(log) {
    std::vector<std::string> words = {
        (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "dataset_recorder").string(),
        "__name:=" + name, "/clock:=/fake_clock"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
      if (std::freopen(log.c_str(), "w", stdout) == nullptr || dup2(STDOUT_FILENO, STDERR_FILENO) < 0) _exit(127);
      // A file that may not grow any more is a disk that is full.
      std::signal(SIGXFSZ, SIG_IGN);
      execv(pointers[0], pointers.data());
      _exit(127);
    }
  }
  ~RecorderProcess() {
    if (running()) {
      signal(SIGKILL);
      wait();
    }
    if (testing::Test::HasFailure()) std::cout << "the node printed:\n" << printed() << std::endl;
  }
  RecorderProcess(const RecorderProcess&) = delete;
  RecorderProcess& operator=(const RecorderProcess&) = delete;

  bool running() {
    int status = 0;
    if (!exit_code_ && waitpid(process_, &status, WNOHANG) == process_) {
      exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    return !exit_code_;
  }

  void signal(int number) { kill(process_, number); }

  /// The exit code, or minus the signal's number; 1000 when it does not end.
  int wait() {
    for (int tries = 0; tries < 3 && !eventually([this] { return !running(); }); ++tries) {
    }
    return exit_code_.value_or(1000);
  }

  /// Files may not get larger than so many bytes; unlimited when empty.
  void limitFiles(const std::optional<rlim_t>& bytes) {
    const rlimit limit{bytes.value_or(RLIM_INFINITY), RLIM_INFINITY};
    ASSERT_EQ(prlimit(process_, RLIMIT_FSIZE, &limit, nullptr), 0);
  }

  std::string printed() const {
    std::ostringstream text;
    text << std::ifstream(log_).rdbuf();
    return text.str();
  }

 private:
  std::string log_;
  pid_t process_ = -1;
  std::optional<int> exit_code_;
};

/// What recorders say on /diagnostics.
class RecorderDiagnostics {
 public:
  RecorderDiagnostics()
      : subscriber_(callbacks_.nodeHandle().subscribe("/diagnostics", 1000, &RecorderDiagnostics::onMessage, this)) {}

  void forget() {
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_.clear();
  }

  /// Level and message are values, too.
  std::string value(const std::string& node, const std::string& key) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return newest_[node][key];
  }

  long count(const std::string& node, const std::string& key) {
    const std::string text = value(node, key);
    return text.empty() ? -1 : std::stol(text);
  }

 private:
  void onMessage(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& status : message->status) {
      auto& values = newest_[status.name.substr(0, status.name.find(':'))];
      values.clear();
      values["level"] = std::to_string(static_cast<int>(status.level));
      values["message"] = status.message;
      for (const auto& entry : status.values) values[entry.key] = entry.value;
    }
  }

  std::mutex mutex_;
  std::map<std::string, std::map<std::string, std::string>> newest_;
  CallbackThread callbacks_;
  ros::Subscriber subscriber_;
};

}  // namespace lstm_planner
