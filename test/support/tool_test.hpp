#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "support/folder_test.hpp"
#include "support/shell.hpp"

namespace lstm_planner::test {

/// Runs the command-line tool as a user does, with a folder for what it writes.
class ToolTest : public FolderTest {
 protected:
  static constexpr const char* kTool = LSTM_PLANNER_TOOL;

  static Outcome runTool(const std::string& arguments) { return runShell(std::string(kTool) + " " + arguments); }

  /// Runs a command of the shell in a folder of the test's own, which is made if there is none.
  Outcome runIn(const std::string& folder, const std::string& command) const {
    return runShell("mkdir -p '" + in(folder) + "' && cd '" + in(folder) + "' || exit 1; " + command);
  }

  /// A training with `--checkpoint model.checkpoint` that gets Ctrl-C as soon as there is something to go on from.
  static std::string interrupted(const std::string& training) {
    return training +
           " & process=$!; until [ -s model.checkpoint ]; do kill -0 $process || break; done; "
           "kill -INT $process; wait $process";
  }

  std::string bytesOf(const std::string& name) const {
    std::ifstream file(in(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }
};

}  // namespace lstm_planner::test
