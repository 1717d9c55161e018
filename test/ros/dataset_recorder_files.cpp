// What is in the file, and what the recorder says of it, whatever happens to the recorder.

#include <tf2_msgs/TFMessage.h>

#include "lstm_planner/dataset/dataset_check.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "ros/fixtures/recorder_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::dataset_recorder_files {
namespace {

constexpr int kOk = diagnostic_msgs::DiagnosticStatus::OK;
constexpr int kWarning = diagnostic_msgs::DiagnosticStatus::WARN;
constexpr int kError = diagnostic_msgs::DiagnosticStatus::ERROR;

/// As `dataset check`.
void expectSoundFile(const std::string& path) {
  const std::vector<std::string> flaws = checkDatasetFile(path);
  EXPECT_TRUE(flaws.empty()) << flaws.front();
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(RecorderTest, DiagnosticsSayWhatIsRecorded) {
  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.4, 0.0, 0.0}, 2.0);
  drive({0.8, 0.4, 0.0}, 2.0);
  drive({0.8, 0.4, 0.0}, 2.0);
  EXPECT_EQ(count("level"), kOk) << value("message");
  EXPECT_EQ(value("message"), "recording");
  EXPECT_EQ(value("file"), file());
  EXPECT_EQ(value("goal"), "(5.00, 0.00) in odom");
  EXPECT_EQ(value("paused"), "no");
  EXPECT_EQ(value("problem"), "");
  EXPECT_EQ(count("episodes"), 1);
  EXPECT_EQ(count("steps"), 8);
  EXPECT_EQ(count("steps stored"), 8);
  EXPECT_EQ(count("steps waiting"), 0);
  EXPECT_EQ(count("label 0"), 4);
  EXPECT_EQ(count("label 45"), 4);
  EXPECT_EQ(count("label -90"), 0);
  EXPECT_GE(count("rejected: standing"), 2);
  EXPECT_GT(count("disk left (MB)"), 0);
}

TEST_F(RecorderTest, DiagnosticsWarnOfADriveWithoutAGoal) {
  start();
  ASSERT_TRUE(eventually([this] {
    stand(kTick);
    return count("level") == kWarning;
  }));
  EXPECT_TRUE(contains(value("message"), "no goal is set")) << value("message");
}

TEST_F(RecorderTest, DiagnosticsNameTheFrameOfAGoalThatIsNotKnown) {
  start();
  giveGoal(goalAt(5.0, 0.0, "nowhere"));
  ASSERT_TRUE(eventually([this] {
    stand(kTick);
    return contains(value("message"), "the goal's frame 'nowhere'");
  })) << value("message");
}

TEST_F(RecorderTest, ARobotThatIsNotThereIsSaidAndLeavesNoFile) {
  recorder_ = launch("dataset_recorder", {});
  const auto warned = [this] { return count("level") == kWarning; };
  ASSERT_TRUE(eventually(warned) || eventually(warned));
  EXPECT_EQ(value("message"), "no odometry on /odom yet");
  EXPECT_TRUE(contains(trigger("finish").message, "no odometry was received on /odom"));
  EXPECT_EQ(recorder_->wait(), 0);
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(RecorderTest, AClockThatStandsIsSaidWhereNothingComes) {
  start();
  const auto is_said = [this] { return contains(value("message"), "the clock stands still: the simulator or rosbag"); };
  EXPECT_TRUE(eventually(is_said)) << value("message");
  EXPECT_EQ(count("level"), kWarning);
}

TEST_F(RecorderTest, TheFileIsReadableWhileItIsRecorded) {
  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.4, 0.0, 0.0}, 2.0);
  const Dataset dataset = readDataset(file(), true);
  ASSERT_EQ(dataset.recordings.size(), 1U);
  EXPECT_FALSE(dataset.recordings[0].finished);
  ASSERT_EQ(dataset.recordings[0].episodes.size(), 1U);
  ASSERT_EQ(dataset.recordings[0].episodes[0].steps.size(), 3U);
  EXPECT_EQ(dataset.recordings[0].episodes[0].steps[0].ranges.size(), 271U) << "one beam a degree";
  drive({0.8, 0.0, 0.0}, 2.0);
  EXPECT_EQ(stepCount(finish()), 8);
}

TEST_F(RecorderTest, WhatWasSaidToBeStoredSurvivesBeingKilled) {
  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.6, 0.0, 0.0}, 3.0);
  const long stored = count("steps stored");
  EXPECT_EQ(stored, 5);
  recorder_->signal(SIGKILL);
  EXPECT_EQ(recorder_->wait(), -SIGKILL);
  expectSoundFile(file());
  const Dataset dataset = readDataset(file());
  EXPECT_GE(stepCount(dataset), stored);
  EXPECT_FALSE(dataset.recordings.at(0).finished);

  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({1.0, 0.0, 0.0}, 2.0);
  const Dataset both = finish();
  ASSERT_EQ(both.recordings.size(), 2U) << "the same file goes on";
  EXPECT_EQ(both.recordings[0].episodes.at(0).steps.size(), static_cast<std::size_t>(stepCount(dataset)));
  EXPECT_TRUE(both.recordings[1].finished);
  expectSoundFile(file());
}

TEST_F(RecorderTest, BeingInterruptedWritesWhatWasHeard) {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::filesystem::remove(file());
    start();
    giveGoal(goalAt(50.0, 0.0));
    const Pose2 pose = robot_.pose();
    drive({pose.x + 0.4, 0.0, 0.0}, 2.0);
    EXPECT_EQ(count("steps"), 3) << "the last scans wait for what may come late";
    recorder_->signal(signal);
    EXPECT_EQ(recorder_->wait(), 0);
    const Dataset dataset = readDataset(file());
    EXPECT_EQ(stepCount(dataset), 4);
    EXPECT_TRUE(dataset.recordings.at(0).finished);
    EXPECT_TRUE(contains(recorder_->printed(), "4 steps in 1 episodes are in " + file())) << recorder_->printed();
  }
}

TEST_F(RecorderTest, ASecondRecorderOfTheSameFileIsRefused) {
  start();
  const auto second = launch("second_recorder", {});
  const auto ended = [&] {
    stand(kTick);
    return !second->running();
  };
  ASSERT_TRUE(eventually(ended) || eventually(ended));
  EXPECT_EQ(second->wait(), 1);
  EXPECT_TRUE(contains(second->printed(), file())) << second->printed();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.4, 0.0, 0.0}, 2.0);
  const Dataset dataset = finish();
  EXPECT_EQ(dataset.recordings.size(), 1U);
  EXPECT_GE(stepCount(dataset), 3);
}

/// As a launch file starts two robots in the same second.
TEST_F(RecorderTest, RecordersOfTwoRobotsHaveFilesOfTheirOwn) {
  const std::string by_default = RecorderNodeParameters().output;
  const std::string output = folder_ / by_default.substr(2, by_default.find("%Y") - 2) + "x.sqlite";
  const auto launchIn = [&](const std::string& robot) {
    return std::make_unique<RecorderProcess>(
        "dataset_recorder", folder_ / (robot + ".log"),
        std::vector<std::string>{"__ns:=/" + robot, "_output:=" + output, "_odom_topic:=/odom", "_scan_topic:=/scan"});
  };
  const auto first = launchIn("robot1");
  const auto second = launchIn("robot2");
  const auto record = [&] {
    robot_.again();
    return std::filesystem::exists(folder_ / "lstm_planner_robot1_x.sqlite") &&
           std::filesystem::exists(folder_ / "lstm_planner_robot2_x.sqlite");
  };
  EXPECT_TRUE(eventually(record) || eventually(record));
  for (const auto& recorder : {first.get(), second.get()}) {
    recorder->signal(SIGINT);
    EXPECT_EQ(recorder->wait(), 0);
  }
  ros::param::del("/robot1");
  ros::param::del("/robot2");
}

TEST_F(RecorderTest, AFullDiskIsSaidAndNothingIsLostOnceThereIsRoomAgain) {
  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.4, 0.0, 0.0}, 2.0);
  recorder_->limitFiles(1);
  drive({0.8, 0.0, 0.0}, 2.0);
  EXPECT_EQ(count("level"), kError);
  EXPECT_TRUE(contains(value("message"), "cannot write")) << value("message");
  EXPECT_GT(count("steps waiting"), 0);
  EXPECT_NE(value("problem"), "");
  EXPECT_TRUE(recorder_->running());
  recorder_->limitFiles(std::nullopt);
  drive({1.2, 0.0, 0.0}, 2.0);
  EXPECT_EQ(count("level"), kOk) << value("message");
  EXPECT_EQ(count("steps waiting"), 0);
  const Dataset dataset = finish();
  EXPECT_EQ(stepCount(dataset), 12);
  EXPECT_EQ(dataset.recordings.at(0).episodes.size(), 1U);
}

TEST_F(RecorderTest, AFileThatCannotGrowIsSaidAndHoldsWhatWasStored) {
  start();
  giveGoal(goalAt(50.0, 0.0));
  drive({0.4, 0.0, 0.0}, 2.0);
  // Write-ahead log and dataset may grow a little, and then no more, wherever in a transaction that is.
  recorder_->limitFiles(std::filesystem::file_size(file()) + 20000);
  ASSERT_TRUE(eventually([this] {
    const Pose2 pose = robot_.pose();
    drive({pose.x + 0.4, 0.0, 0.0}, 2.0);
    return count("level") == kError;
  }));
  const std::string sentence = "dataset '" + file() + "'";
  EXPECT_TRUE(contains(value("message"), "cannot write") && contains(value("message"), sentence)) << value("message");
  const auto isLogged = [&] { return contains(recorder_->printed(), "cannot write"); };
  EXPECT_TRUE(eventually(isLogged) || eventually(isLogged)) << "every ten seconds";
  const long stored = count("steps stored");
  EXPECT_GT(stored, 0);
  recorder_->signal(SIGTERM);
  EXPECT_EQ(recorder_->wait(), 1) << "what waits is lost";
  EXPECT_TRUE(contains(recorder_->printed(), "steps are not in it")) << recorder_->printed();
  expectSoundFile(file());
  EXPECT_EQ(stepCount(readDataset(file())), stored);
}

TEST_F(RecorderTest, ATransformAtTheEndOfTimeIsSaidAndRecordingGoesOn) {
  ros::Publisher transforms = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 10);
  start();
  giveGoal(goalAt(5.0, 0.0));
  EXPECT_TRUE(eventually([&] {
    transforms.publish(transformAtTheEndOfTime());
    return contains(recorder_->printed(), "is not used: it is stamped 4294967296");
  }));
  drive({0.4, 0.0, 0.0}, 2.0);
  EXPECT_GE(stepCount(finish()), 3);
}

TEST_F(RecorderTest, BadParametersEndTheNodeWithASentence) {
  const auto period = launch("dataset_recorder", {"_period:=-1.0"});
  EXPECT_EQ(period->wait(), 1);
  EXPECT_TRUE(contains(period->printed(), "parameter period is -1, expected a number in [0.0001, 3600]"))
      << period->printed();
  ros::param::del("/dataset_recorder");

  RecorderProcess folder("dataset_recorder", folder_ / "log", {"_output:=/proc/nowhere/drive.sqlite"});
  EXPECT_EQ(folder.wait(), 1);
  EXPECT_TRUE(contains(folder.printed(), "cannot make the folder of /proc/nowhere/drive.sqlite")) << folder.printed();
}

TEST_F(RecorderTest, AFileThatIsNoDatasetIsLeftAlone) {
  std::ofstream(file()) << "a shopping list";
  recorder_ = launch("dataset_recorder", {});
  const auto ended = [&] {
    robot_.again();
    return !recorder_->running();
  };
  ASSERT_TRUE(eventually(ended) || eventually(ended));
  EXPECT_EQ(recorder_->wait(), 1);
  std::string text;
  std::getline(std::ifstream(file()), text);
  EXPECT_EQ(text, "a shopping list");
}

const RosProgram program("dataset_recorder_files", &runTests);

}  // namespace
}  // namespace lstm_planner::dataset_recorder_files
