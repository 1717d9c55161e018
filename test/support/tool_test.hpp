#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

#include "support/folder_test.hpp"

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
class ToolTest : public FolderTest {
 protected:
  static constexpr const char* kTool = LSTM_PLANNER_TOOL;

  static Outcome runTool(const std::string& arguments) { return runShell(std::string(kTool) + " " + arguments); }
};

}  // namespace lstm_planner::test
