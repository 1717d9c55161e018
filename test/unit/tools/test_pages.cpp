// The pages' commands of the tool have no option that does not exist, programs on pages are those that are tested, and
// lines of text fit into a terminal.

#include <gtest/gtest.h>

#include <algorithm>
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

/// Of UTF-8.
std::size_t lettersOf(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

/// The lines of running text that are too long to be read in a terminal.
std::string longLinesOf(const fs::path& page) {
  constexpr std::size_t kMost = 140;
  std::ifstream file(page);
  std::string lines;
  bool is_code = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("```", 0) == 0) is_code = !is_code;
    if (!is_code && line.find_first_not_of(' ') != line.find('|') && lettersOf(line) > kMost) lines += line + "\n";
  }
  return lines;
}

TEST(PagesLines, HaveAtMost140Letters) {
  const fs::path source = LSTM_PLANNER_SOURCE_DIR;
  std::vector<fs::path> pages{source / "README.md", source / "CHANGELOG.rst"};
  for (const char* folder : {"config", "launch", "models", "test"}) {
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
    }
  }
  EXPECT_GT(pages.size(), 15u);
  for (const fs::path& page : pages) EXPECT_EQ(longLinesOf(page), "") << page;
}

TEST(EmbedPage, ShowsTheProgramThatIsTested) {
  const fs::path source = LSTM_PLANNER_SOURCE_DIR;
  const std::string program = contentOf(source / "test/consumer/consumer.cpp");
  EXPECT_FALSE(program.empty());
  EXPECT_NE(contentOf(source / "models/embed.md").find("```cpp\n" + program + "```"), std::string::npos);
}

}  // namespace
}  // namespace lstm_planner::test_pages
