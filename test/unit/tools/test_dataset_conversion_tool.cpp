// The commands `lstm_planner dataset from-bag` and `from-log` as a user runs them.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "support/real_data.hpp"
#include "support/tool_test.hpp"

namespace lstm_planner::test_dataset_conversion_tool {
namespace {

class DatasetConversionTool : public test::ToolTest {
 protected:
  static test::Outcome convert(const std::string& arguments) { return runTool("dataset " + arguments); }

  /// A robot that drives straight ahead, with a scan every half metre, which takes it `period` s.
  std::string log(const std::string& name, int last = 10, const std::string& reading = "3.5", int period = 1) const {
    std::ofstream file(in(name));
    for (int i = 0; i <= last; ++i) {
      file << "FLASER 180";
      for (int beam = 0; beam < 180; ++beam) file << " " << reading;
      const std::string pose = " " + std::to_string(0.5 * i) + " 0 0";
      file << pose << pose << " " << 100 + period * i << " host " << 100 + period * i << "\n";
    }
    return in(name);
  }
};

TEST_F(DatasetConversionTool, LogsBecomeRecordingsOfOneDataset) {
  const std::string first = log("first.log");
  const std::string second = log("second.log");
  const test::Outcome outcome =
      convert("from-log " + first + " " + second + " --mount \"0.1 0 0\" --no-scans --output " + in("out.sqlite"));
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("11 scans FLASER"), std::string::npos) << outcome.output;
  const Dataset dataset = readDataset(in("out.sqlite"), true);
  ASSERT_EQ(dataset.recordings.size(), 2u);
  EXPECT_EQ(dataset.recordings[0].description.source, first);
  EXPECT_EQ(dataset.recordings[1].description.source, second);
  for (const Recording& recording : dataset.recordings) {
    EXPECT_TRUE(recording.finished);
    EXPECT_FALSE(recording.description.parameters.keep_scans);
    ASSERT_EQ(recording.episodes.size(), 1u);
    // Steps start at 0, 0.5 ... 4.5 m; the last, at the goal, is labelled by none.
    ASSERT_EQ(recording.episodes[0].steps.size(), 9u);
    EXPECT_TRUE(recording.episodes[0].steps[0].ranges.empty());
    EXPECT_EQ(recording.episodes[0].steps[0].geometry.mount.pose.x, 0.1);
  }
}

TEST_F(DatasetConversionTool, WhatCannotBeConvertedIsRefusedAndNothingIsWritten) {
  std::ofstream(in("text.txt")) << "no log\n";
  std::ofstream(in("there.sqlite")) << "something\n";
  struct Case {
    std::string arguments;
    std::string sentence;
  };
  for (const Case& bad :
       {Case{"from-log " + in("text.txt"), "holds no scans"},
        {"from-log " + in("none.log"), "cannot be read"},
        {"from-bag " + in("text.txt"), "cannot be read"},
        {"from-bag " + in("none.bag") + " --hindsight", "none.bag"},
        {"from-bag", "--bag is required"},
        {"from-log " + log("a.log") + " --mount 1", "option --mount is '1', expected \"x y yaw\""},
        {"from-log " + log("a.log") + " --period 0", "--period is 0, expected a number in [0.0001, 3600]"},
        {"from-log " + log("a.log") + " --shortest 0.2", "more than the goal tolerance"},
        {"from-bag " + folder_, "holds no bags, expected files *.bag"}}) {
    const test::Outcome outcome = convert(bad.arguments + " --output " + in("out.sqlite"));
    EXPECT_EQ(outcome.status, 2) << bad.arguments;
    EXPECT_NE(outcome.output.find(bad.sentence), std::string::npos) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(in("out.sqlite"))) << bad.arguments;
  }
  const test::Outcome outcome = convert("from-log " + log("a.log") + " --output " + in("there.sqlite"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.output.find("already"), std::string::npos) << outcome.output;
}

/// Nothing of what the process prints is shown. It heeds SIGINT, which shells let their background processes ignore.
::pid_t start(std::vector<std::string> words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const ::pid_t process = ::fork();
  if (process == 0) {
    ::signal(SIGINT, SIG_DFL);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::execv(pointers[0], pointers.data());
    ::_exit(127);
  }
  return process;
}

TEST_F(DatasetConversionTool, WhatWasConvertedBeforeAnErrorStays) {
  std::ofstream(in("text.txt")) << "no log\n";
  const test::Outcome outcome =
      convert("from-log " + log("a.log") + " " + in("text.txt") + " --output " + in("out.sqlite"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.output.find("holds no scans"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("out.sqlite: 9 steps of what was converted before the error"), std::string::npos)
      << outcome.output;
  EXPECT_EQ(stepCount(readDataset(in("out.sqlite"))), 9);
}

TEST_F(DatasetConversionTool, AFolderOfBagsIsConvertedDriveByDrive) {
  const test::Outcome outcome =
      convert(std::string("from-bag " LSTM_PLANNER_SOURCE_DIR "/test/bags --no-scans --output ") + in("out.sqlite"));
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const Dataset dataset = readDataset(in("out.sqlite"));
  ASSERT_EQ(dataset.recordings.size(), 3u) << "they were not recorded at once";
  EXPECT_EQ(stepCount(dataset), 60 + 87 + 98) << "as test/bags/README.md has them";
}

TEST_F(DatasetConversionTool, WithoutAnyStepItSaysWhyAndFails) {
  const test::Outcome outcome = convert("from-log " + log("dark.log", 10, "0.0") + " --output " + in("out.sqlite"));
  EXPECT_EQ(outcome.status, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("unusable scan, 11 times: the scan has 0 of "), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("out.sqlite is not written: there is no step"), std::string::npos) << outcome.output;
  EXPECT_FALSE(std::filesystem::exists(in("out.sqlite")));
}

TEST_F(DatasetConversionTool, LogsWhoseTimesAreLostAreSaidToBe) {
  const test::Outcome lost = convert("from-log " + log("lost.log", 10, "3.5", 0) + " --output " + in("out.sqlite"));
  EXPECT_EQ(lost.status, 1) << lost.output;
  EXPECT_NE(lost.output.find("the log's times are lost: 10 of 11 scans are stamped no later than the scan before; "
                             "expected the raw log"),
            std::string::npos)
      << lost.output;
  const test::Outcome dark = convert("from-log " + log("dark.log", 10, "0.0") + " --output " + in("out.sqlite"));
  EXPECT_EQ(dark.output.find("times are lost"), std::string::npos) << "its scans are a second apart: " << dark.output;
}

TEST_F(DatasetConversionTool, NothingIsLeftOfAConversionThatIsInterruptedWhileItWrites) {
  const std::string drive = log("long.log", 2000);
  std::filesystem::create_directory(in("out"));
  const auto files = [this] { return std::filesystem::directory_iterator(in("out")); };
  const auto is_writing = [&] {  // before it works, it only tries whether it could
    return std::any_of(begin(files()), end(files()), [](const auto& entry) {
      std::error_code gone;
      const auto size = entry.file_size(gone);
      return !gone && size > 0;
    });
  };
  const ::pid_t process =
      start({kTool, "dataset", "from-log", drive, "--max-gap", "100", "--output", in("out/it.sqlite")});
  int status = 0;
  while (!is_writing() && ::waitpid(process, &status, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_FALSE(std::filesystem::exists(in("out/it.sqlite"))) << "it still writes";
  ::kill(process, SIGINT);
  ::waitpid(process, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
  EXPECT_TRUE(std::filesystem::is_empty(in("out")));
}

TEST_F(DatasetConversionTool, BagsWithoutGoalsNameHindsight) {
  const std::string bag = realData("bags/racecar_ust10lx_loc1.bag");
  SKIP_WITHOUT_REAL_DATA(bag);
  const std::string arguments = "from-bag " + bag + " --max-speed 5 --output " + in("out.sqlite");
  const test::Outcome refused = convert(arguments);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.output.find("--hindsight"), std::string::npos) << refused.output;
  const test::Outcome guessed = convert(arguments + " --hindsight");
  EXPECT_EQ(guessed.status, 2);
  EXPECT_NE(guessed.output.find("has no transform from "), std::string::npos) << guessed.output;
  const test::Outcome outcome = convert(arguments + " --hindsight --mount '0 0 0'");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const Dataset dataset = readDataset(in("out.sqlite"));
  EXPECT_GE(stepCount(dataset), 7);  // two looks a second of 7 s, less standing and the last 0.3 m
  EXPECT_EQ(dataset.recordings.at(0).description.begun, "2022-03-29T23:23:29Z");
}

}  // namespace
}  // namespace lstm_planner::test_dataset_conversion_tool
