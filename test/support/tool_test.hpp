#pragma once

#include <string>

#include "support/folder_test.hpp"
#include "support/shell.hpp"

namespace lstm_planner::test {

/// Runs the command-line tool as a user does, with a folder for what it writes.
class ToolTest : public FolderTest {
 protected:
  static constexpr const char* kTool = LSTM_PLANNER_TOOL;

  static Outcome runTool(const std::string& arguments) { return runShell(std::string(kTool) + " " + arguments); }
};

}  // namespace lstm_planner::test
