#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace lstm_planner::test_troubleshooting {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

fs::path inSource(const std::string& path) { return fs::path(LSTM_PLANNER_SOURCE_DIR) / path; }

/// The sources in these folders, with literals over several lines made one.
std::string sourcesIn(const std::vector<std::string>& folders) {
  std::string text;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::directory_iterator(inSource(folder))) text += contentOf(entry.path());
  }
  return std::regex_replace(text, std::regex("\"\\s*\\n\\s*\""), "");
}

/// Of the nodes that move no robot but the simulated one.
const std::vector<std::string> kNodes{"src/ros/recorder", "src/ros/advice", "src/ros/replay", "src/ros/create2_stub"};

/// The sources whose messages tell a user why the robot does not move, or why a node does not work.
std::string messageSources() {
  std::vector<std::string> folders{"src/ros/planner",     "src/ros/controller",  "src/ros/common",
                                   "src/ros/move_base",   "src/compat",          "src/drive/perception",
                                   "src/drive/local_map", "src/drive/collision", "src/drive/decision",
                                   "src/drive/motion",    "src/dataset",         "src/grid"};
  folders.insert(folders.end(), kNodes.begin(), kNodes.end());
  return sourcesIn(folders);
}

/// What matches the first group.
std::vector<std::string> found(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> all;
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match) {
    all.push_back((*match)[1]);
  }
  return all;
}

/// The messages in the first columns of the page's tables.
std::vector<std::string> messagesOfThePage() {
  std::vector<std::string> messages;
  for (const std::string& column : found(contentOf(inSource("launch/troubleshooting.md")), "\n\\| ([^|]*`[^|]*) \\|")) {
    for (const std::string& message : found(column, "`([^`]*)`")) messages.push_back(message);
  }
  return messages;
}

TEST(Troubleshooting, TellsOfMessagesThatThereAre) {
  const std::string sources = messageSources();
  const std::vector<std::string> messages = messagesOfThePage();
  EXPECT_GT(messages.size(), 25u);
  for (const std::string& message : messages) {
    for (const std::string& fixed : found(message + "...", "(.*?)\\.\\.\\.")) {
      if (fixed.find_first_not_of(" ,:") == std::string::npos) continue;
      EXPECT_NE(sources.find(fixed), std::string::npos) << "'" << fixed << "' of '" << message << "'";
    }
  }
}

TEST(Troubleshooting, TellsOfEveryReasonToStand) {
  const std::string page = contentOf(inSource("launch/troubleshooting.md"));
  std::vector<std::string> reasons =
      found(messageSources(), "throw (?:SensorError|FrameError|PlanRefused|OutdatedPlan|UnusableScan)\\(\"([^\"(]*)");
  EXPECT_GT(reasons.size(), 15u);
  const std::vector<std::string> refused =
      found(sourcesIn({"src/ros/common", "src/ros/planner"}), "throw std::invalid_argument\\(\"(the [^\"(]*)");
  EXPECT_GE(refused.size(), 4u);
  const std::vector<std::string> too_far =
      found(contentOf(inSource("src/drive/perception/reach.cpp")), "throw std::invalid_argument\\(\"([^\"(]*)");
  EXPECT_EQ(too_far.size(), 2u);
  reasons.insert(reasons.end(), refused.begin(), refused.end());
  reasons.insert(reasons.end(), too_far.begin(), too_far.end());
  for (std::string reason : reasons) {
    reason.erase(reason.find_last_not_of(" '") + 1);
    EXPECT_NE(page.find(reason), std::string::npos) << "'" << reason << "' is not in launch/troubleshooting.md";
  }
}

/// What the page has to show of a message in printf's form: without the line's usual beginning, and what follows a
/// colon may be left out.
std::string shownOnThePage(const std::string& format) {
  std::string shown = std::regex_replace(format, std::regex("^(no plan|the robot stands): "), "");
  shown = std::regex_replace(shown, std::regex("%[-.0-9]*(?:zu|ld|[dufsg])"), "...");
  constexpr std::size_t kShortest = 12;  // an earlier colon is behind a name
  const std::size_t colon = shown.find(": ", kShortest);
  return colon == std::string::npos ? shown : shown.substr(0, colon);
}

TEST(Troubleshooting, TellsOfEveryWarningAndError) {
  const std::string page = contentOf(inSource("launch/troubleshooting.md"));
  std::vector<std::string> messages =
      found(messageSources(), "ROS_(?:WARN|ERROR|FATAL)(?:_THROTTLE|_ONCE)?\\(\\s*(?:[\\w.]+,\\s*)?\"([^\"]*)\"");
  EXPECT_GT(messages.size(), 25u);
  const std::vector<std::string> aborts =
      found(messageSources(), "abort\\((?:\\w+ \\? )?(?:std::string\\()?\"([^\"]*)\"");
  EXPECT_GE(aborts.size(), 5u);
  messages.insert(messages.end(), aborts.begin(), aborts.end());
  for (const std::string& message : messages) {
    const std::string shown = shownOnThePage(message);
    if (shown == "...") continue;  // the text comes from an exception
    EXPECT_NE(page.find(shown), std::string::npos) << "'" << shown << "' is not in launch/troubleshooting.md";
  }
}

/// Each literal of a statement that is long enough to be found in a log.
std::vector<std::string> sentencesOf(const std::string& statement) {
  constexpr std::size_t kLongEnough = 12;
  std::vector<std::string> sentences;
  for (std::string literal : found(statement, "\"([^\"]*)\"")) {
    if (literal.size() < kLongEnough) continue;
    literal.erase(0, literal.find_first_not_of(" ',:"));
    literal.erase(literal.find_last_not_of(" '(") + 1);
    sentences.push_back(shownOnThePage(literal));
  }
  return sentences;
}

TEST(Troubleshooting, TellsWhyANodeEndsOrRefusesAFile) {
  const std::string page = contentOf(inSource("launch/troubleshooting.md"));
  std::vector<std::string> statements = found(sourcesIn(kNodes), "throw (?!std::logic_error)([^;]*);");
  EXPECT_GT(statements.size(), 20u);
  const std::vector<std::string> texts = found(sourcesIn({"src/ros/create2_stub"}), "text << ([^;]*);");
  EXPECT_GE(texts.size(), 3u);
  statements.insert(statements.end(), texts.begin(), texts.end());
  for (const std::string& statement : statements) {
    for (const std::string& sentence : sentencesOf(statement)) {
      EXPECT_NE(page.find(sentence), std::string::npos) << "'" << sentence << "' is not in launch/troubleshooting.md";
    }
  }
}

TEST(Troubleshooting, TellsOfEveryWarningOfTheRecordersStatus) {
  const std::string page = contentOf(inSource("launch/troubleshooting.md"));
  const std::string source = contentOf(inSource("src/ros/recorder/dataset_recorder_status.cpp"));
  std::vector<std::string> statements = found(source, "\\{DiagnosticStatus::(?:WARN|ERROR),([^;]*);");
  EXPECT_GE(statements.size(), 6u);
  for (const std::string& statement : found(source, "return (\"no [^;]*);")) statements.push_back(statement);
  for (const std::string& statement : statements) {
    for (const std::string& sentence : sentencesOf(statement)) {
      EXPECT_NE(page.find(sentence), std::string::npos) << "'" << sentence << "' is not in launch/troubleshooting.md";
    }
  }
}

TEST(Troubleshooting, TellsWhyAGoalIsRefused) {
  const std::string page = contentOf(inSource("launch/troubleshooting.md"));
  const std::vector<std::string> reasons = found(contentOf(inSource("src/ros/move_base/standalone_move_base.cpp")),
                                                 "throw std::invalid_argument\\(\"([^\"]*)\"");
  EXPECT_GE(reasons.size(), 5u);
  for (const std::string& reason : reasons) {
    EXPECT_NE(page.find(reason), std::string::npos) << "'" << reason << "' is not in launch/troubleshooting.md";
  }
}

}  // namespace
}  // namespace lstm_planner::test_troubleshooting
