#pragma once

#include <sys/wait.h>

#include <cstdio>
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

}  // namespace lstm_planner::test
