// The pages' commands of the tool have no option that does not exist, and programs on pages are those that are tested.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "support/tool_test.hpp"

namespace lstm_planner::test_pages {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return std::regex_replace(text, std::regex(R"(\\\n)"), " ");  // a command of several lines
}

/// What stands behind "lstm_planner": in blocks of commands, and between backquotes.
std::vector<std::string> commandsOf(const std::string& page) {
  static const std::regex kForms(R"((?:\n *|`)lstm_planner (\w[^\n`#]*))");
  std::vector<std::string> commands;
  for (std::sregex_iterator match(page.begin(), page.end(), kForms), end; match != end; ++match) {
    commands.push_back((*match)[1]);
  }
  return commands;
}

class Pages : public test::ToolTest, public testing::WithParamInterface<const char*> {};

TEST_P(Pages, NameOptionsThatThereAre) {
  const std::vector<std::string> commands =
      commandsOf(contentOf(std::string(LSTM_PLANNER_SOURCE_DIR) + "/" + GetParam()));
  EXPECT_FALSE(commands.empty());
  for (const std::string& command : commands) {
    const test::Outcome outcome =
        test::runShell("s=1; building=house.yaml; cd '" + folder_ + "'; " + kTool + " " + command + " --help");
    EXPECT_EQ(outcome.status, 0) << "lstm_planner " << command << "\n" << outcome.output;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Pages,
                         testing::Values("README.md", "config/README.md", "config/parameters.md", "launch/README.md",
                                         "models/README.md", "models/create2_lstm.md", "models/grid_world.md",
                                         "models/onnx.md", "models/recorded_drives.md", "models/structure_search.md",
                                         "models/thesis.md", "test/bench/README.md"),
                         [](const auto& page) { return std::regex_replace(page.param, std::regex(R"(\W)"), "_"); });

TEST(EmbedPage, ShowsTheProgramThatIsTested) {
  const fs::path source = LSTM_PLANNER_SOURCE_DIR;
  const std::string program = contentOf(source / "test/consumer/consumer.cpp");
  EXPECT_FALSE(program.empty());
  EXPECT_NE(contentOf(source / "models/embed.md").find("```cpp\n" + program + "```"), std::string::npos);
}

}  // namespace
}  // namespace lstm_planner::test_pages
