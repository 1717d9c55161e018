#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace lstm_planner::test {

/// How a command ended.
struct Outcome {
  int status = -1;
  std::string output;  ///< with what went to standard error
};

inline Outcome runShell(const std::string& command) {
  Outcome outcome;
  FILE* pipe = ::popen(("exec 2>&1; " + command).c_str(), "r");
  if (pipe == nullptr) return outcome;
  char buffer[4096];
  for (std::size_t count; (count = std::fread(buffer, 1, sizeof(buffer), pipe)) > 0;) {
    outcome.output.append(buffer, count);
  }
  const int status = ::pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// Runs the command-line tool as a user does, with a folder for what it writes.
class ToolTest : public ::testing::Test {
 protected:
  static constexpr const char* kTool = LSTM_PLANNER_TOOL;

  void SetUp() override {
    std::string pattern = ::testing::TempDir() + "tool_XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::error_code unknown;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, unknown);
  }

  std::string in(const std::string& name) const { return folder_ + "/" + name; }

  static Outcome runTool(const std::string& arguments) { return runShell(std::string(kTool) + " " + arguments); }

  std::string folder_;
};

}  // namespace lstm_planner::test
