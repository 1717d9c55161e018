// What becomes of a recording when the recorder is killed, the disk is full, or somebody else has the file.

#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <thread>

#include "dataset/dataset_file.hpp"
#include "lstm_planner/dataset/dataset_writer.hpp"
#include "unit/dataset/dataset_fixtures.hpp"

namespace lstm_planner::test_dataset_durability {
namespace {

constexpr const char* kRecorderVariable = "LSTM_PLANNER_TEST_RECORDER";
constexpr int kBeams = 300;
constexpr int kNotPossible = 77;  // exit status

void limitFileSize(rlim_t bytes) {
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = bytes;
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

void expect(bool condition, const std::string& sentence) {
  if (condition) return;
  std::cout << sentence << std::endl;
  ::_exit(1);
}

/// Records, and says so on standard output, step by step, after the writer has returned.
void recordSteps(const std::string& path) {
  const RecordedEpisode episode = exampleEpisode(500, 1, kBeams);
  DatasetWriter writer(path, exampleDescription());
  writer.startEpisode(Episode());
  for (const DriveStep& step : episode.steps) {
    writer.addStep(step);
    std::cout << "\n" << std::flush;
  }
}

/// Records until steps wait, lets `make_room` do its work, and expects everything to be in the file then.
template <typename MakeRoom>
void recordUntilFull(const std::string& path, MakeRoom&& make_room) {
  const RecordedEpisode episode = exampleEpisode(500, 1, kBeams);
  DatasetWriter writer(path, exampleDescription());
  expect(writer.problem().empty(), writer.problem());
  writer.startEpisode(episode.episode);
  std::size_t next = 0;
  constexpr long kWaiting = 20;
  while (writer.waiting() < kWaiting && next + 1 < episode.steps.size()) writer.addStep(episode.steps[next++]);
  expect(writer.waiting() == kWaiting, "no step waits");
  expect(writer.stored() > 0, "none was stored");
  expect(writer.problem().find("cannot be written: ") != std::string::npos,
         "the problem is '" + writer.problem() + "'");
  const Dataset before = readDataset(path, true);
  expect(stepCount(before) == writer.stored(), "the file holds other steps than those that were stored");
  make_room();
  writer.addStep(episode.steps[next++]);
  expect(writer.waiting() == 0 && writer.problem().empty(), "still: " + writer.problem());
  writer.finish();
  const Dataset dataset = readDataset(path, true);
  const std::vector<DriveStep>& steps = dataset.recordings[0].episodes[0].steps;
  expect(steps.size() == next, "a step is missing");
  for (std::size_t i = 0; i < next; ++i) expect(steps[i].stamp == episode.steps[i].stamp, "out of order");
}

/// Mounts a disk that only this process sees.
bool mountSmallDisk(const std::string& folder) {
  const std::string user = std::to_string(::getuid());
  const std::string group = std::to_string(::getgid());
  if (::unshare(CLONE_NEWNS) != 0) {
    if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << user << " " << user << " 1";
    std::ofstream("/proc/self/gid_map") << group << " " << group << " 1";
  }
  return ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount("none", folder.c_str(), "tmpfs", 0, "size=256k") == 0;
}

void recordOnSmallDisk(const std::string& path) {
  const std::string disk = path + ".disk";
  std::filesystem::create_directory(disk);
  if (!mountSmallDisk(disk)) ::_exit(kNotPossible);
  recordUntilFull(disk + "/a.db", [&] {
    expect(::mount("none", disk.c_str(), "tmpfs", MS_REMOUNT, "size=8m") == 0, "the disk cannot be made larger");
  });
}

/// The test executable runs itself again as the recorder whose end is tested. Only then this does something, before any
/// test starts, and does not return. A fork would not do: of Poco's threads it takes along only what they left behind.
bool runAsRecorderIfAsked() {
  const char* order = std::getenv(kRecorderVariable);
  if (order == nullptr) return false;
  std::istringstream words(order);
  std::string mode;
  std::string path;
  rlim_t limit = 0;
  words >> mode >> path >> limit;
  try {
    if (limit > 0) limitFileSize(limit);
    if (mode == "steps") recordSteps(path);
    if (mode == "limited") {
      ::signal(SIGXFSZ, SIG_IGN);
      recordUntilFull(path, [] { limitFileSize(RLIM_INFINITY); });
    }
    if (mode == "full") recordOnSmallDisk(path);
  } catch (const std::exception& error) {
    expect(false, error.what());
  }
  ::_exit(0);
}
const bool kIsRecorder = runAsRecorderIfAsked();

/// A recorder in a process of its own.
class Recorder {
 public:
  Recorder(const std::string& mode, const std::string& path, long limit = 0) {
    int ends[2];
    if (::pipe(ends) != 0) return;
    const std::string order = mode + " " + path + " " + std::to_string(limit);
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]);
      ::close(ends[1]);
      ::setenv(kRecorderVariable, order.c_str(), 1);
      const rlimit no_core{0, 0};
      ::setrlimit(RLIMIT_CORE, &no_core);
      ::execl("/proc/self/exe", "recorder", static_cast<char*>(nullptr));
      ::_exit(1);
    }
    ::close(ends[1]);
    output_ = ::fdopen(ends[0], "r");
  }
  ~Recorder() {
    if (!has_ended_) kill();
    if (output_ != nullptr) std::fclose(output_);
  }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Waits for so many acknowledged steps; false when the recorder ended before.
  bool waitForSteps(int steps) {
    for (; steps > 0; --steps, ++acknowledged_) {
      if (std::fgetc(output_) == EOF) return false;
    }
    return true;
  }

  /// Returns how many steps were acknowledged, and the status of the process.
  std::pair<int, int> kill() {
    ::kill(process_, SIGKILL);
    return end();
  }
  std::pair<int, int> end() {
    while (waitForSteps(1)) {
    }
    int status = 0;
    ::waitpid(process_, &status, 0);
    has_ended_ = true;
    return {acknowledged_, status};
  }

  /// Waits for the end; what was said on the way.
  std::string words(int* exit_status) {
    std::string text;
    for (int c = std::fgetc(output_); c != EOF; c = std::fgetc(output_)) text += static_cast<char>(c);
    const int status = end().second;
    *exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return text;
  }

 private:
  pid_t process_ = 0;
  FILE* output_ = nullptr;
  int acknowledged_ = 0;
  bool has_ended_ = false;
};

class DatasetDurability : public DatasetTest {
 protected:
  /// Of the recorder, every acknowledged step must be in the file, and at most the one that it was at beside them.
  void expectAcknowledged(int acknowledged) const {
    const RecordedEpisode expected = exampleEpisode(acknowledged + 1, 1, kBeams);
    const Dataset dataset = readDataset(in("a.db"), true);
    ASSERT_EQ(dataset.recordings.size(), 1u);
    EXPECT_FALSE(dataset.recordings[0].finished);
    ASSERT_EQ(dataset.recordings[0].episodes.size(), 1u);
    EXPECT_EQ(dataset.recordings[0].episodes[0].episode.end, EpisodeEnd::kRunning);
    const std::vector<DriveStep>& steps = dataset.recordings[0].episodes[0].steps;
    ASSERT_GE(steps.size(), static_cast<std::size_t>(acknowledged));
    ASSERT_LE(steps.size(), expected.steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(steps[i].stamp, expected.steps[i].stamp);
      EXPECT_EQ(steps[i].ranges.size(), static_cast<std::size_t>(kBeams));
    }
    EXPECT_NO_THROW(DatasetWriter(in("a.db"), exampleDescription())) << "recording can go on";
    EXPECT_EQ(readDataset(in("a.db")).recordings.size(), 2u);
  }
};

TEST_F(DatasetDurability, KeepsEveryAcknowledgedStepWhenKilledAtAnyMoment) {
  Random random(3);
  for (int i = 0; i < 8; ++i) {
    Recorder recorder("steps", in("a.db"));
    ASSERT_TRUE(recorder.waitForSteps(1 + static_cast<int>(uniformIndex(random, 12))));
    // A commit takes some milliseconds; the kill is to hit it anywhere.
    std::this_thread::sleep_for(std::chrono::microseconds(uniformIndex(random, 15000)));
    const auto [acknowledged, status] = recorder.kill();
    EXPECT_TRUE(WIFSIGNALED(status));
    expectAcknowledged(acknowledged);
    std::filesystem::remove(in("a.db"));
  }
}

TEST_F(DatasetDurability, RollsBackWhatWasHalfWritten) {
  // The process is ended by the system in the middle of the write that makes a file longer than this.
  int journals = 0;
  for (long limit = 60001; limit < 90000; limit += 4733) {
    Recorder recorder("steps", in("a.db"), limit);
    const auto [acknowledged, status] = recorder.end();
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ);
    EXPECT_GT(acknowledged, 0);
    journals += std::filesystem::exists(in("a.db-journal")) ? 1 : 0;
    expectAcknowledged(acknowledged);
    std::filesystem::remove(in("a.db"));
  }
  EXPECT_GT(journals, 0) << "or nothing was half written";
}

TEST_F(DatasetDurability, KeepsStepsInMemoryWhileTheFileCannotGrow) {
  int status = -1;
  const std::string words = Recorder("limited", in("a.db"), 150000).words(&status);
  EXPECT_EQ(status, 0) << words;
}

TEST_F(DatasetDurability, KeepsStepsInMemoryWhileTheDiskIsFull) {
  int status = -1;
  const std::string words = Recorder("full", in("a.db")).words(&status);
  if (status == kNotPossible) GTEST_SKIP() << "a small disk needs the right to mount one";
  EXPECT_EQ(status, 0) << words;
}

TEST_F(DatasetDurability, GoesOnWhileAReaderHasTheFile) {
  const RecordedEpisode episode = exampleEpisode(3, 1);
  DatasetWriter writer(in("a.db"), exampleDescription());
  writer.startEpisode(episode.episode);
  writer.addStep(episode.steps[0]);
  DatasetFile reader(in("a.db"), DatasetFile::Use::kRead, 0);
  reader.transact([&] {
    EXPECT_EQ(reader.numberOf("SELECT count(*) FROM steps"), 1);
    writer.addStep(episode.steps[1]);
    EXPECT_EQ(writer.waiting(), 1);
    EXPECT_EQ(writer.problem(), "dataset '" + in("a.db") + "' cannot be written: database is locked");
    EXPECT_EQ(reader.numberOf("SELECT count(*) FROM steps"), 1);
  });
  writer.addStep(episode.steps[2]);
  EXPECT_EQ(writer.waiting(), 0);
  EXPECT_EQ(writer.problem(), "");
  EXPECT_EQ(reader.numberOf("SELECT count(*) FROM steps"), 3);
}

TEST_F(DatasetDurability, IsReadWhileItIsRecorded) {
  const RecordedEpisode episode = exampleEpisode(40, 1, kBeams);
  DatasetWriter writer(in("a.db"), exampleDescription());
  writer.startEpisode(Episode());
  std::atomic<bool> is_recording{true};
  long reads = 0;
  std::thread reader([&] {
    long last = 0;
    while (is_recording || reads == 0) {
      const Dataset dataset = readDataset(in("a.db"), true);
      EXPECT_GE(stepCount(dataset), last) << "what was there stays there";
      last = stepCount(dataset);
      for (const DriveStep& step : dataset.recordings[0].episodes[0].steps) {
        EXPECT_EQ(step.stamp, episode.steps[static_cast<std::size_t>(step.number)].stamp);
        EXPECT_EQ(step.ranges.size(), static_cast<std::size_t>(kBeams));
      }
      ++reads;
    }
  });
  for (const DriveStep& step : episode.steps) writer.addStep(step);
  is_recording = false;
  reader.join();
  writer.finish();
  EXPECT_EQ(writer.stored(), 40);
  EXPECT_EQ(writer.lost(), 0);
  EXPECT_EQ(stepCount(readDataset(in("a.db"))), 40);
}

TEST_F(DatasetDurability, SaysWhenTheFileIsMovedAwayAndWhatIsLost) {
  constexpr long kMostWaiting = 10000;
  const RecordedEpisode episode = exampleEpisode(static_cast<int>(kMostWaiting) + 7, 1, 0);
  DatasetWriter writer(in("a.db"), exampleDescription());
  writer.startEpisode(episode.episode);
  writer.addStep(episode.steps[0]);
  std::filesystem::rename(in("a.db"), in("b.db"));
  for (std::size_t i = 1; i + 1 < episode.steps.size(); ++i) writer.addStep(episode.steps[i]);
  EXPECT_EQ(writer.problem(),
            "dataset '" + in("a.db") + "' cannot be written: it was moved or deleted while being recorded");
  EXPECT_EQ(writer.waiting(), kMostWaiting);
  EXPECT_EQ(writer.lost(), 5);
  EXPECT_THROW(writer.finish(), DatasetError);
  std::filesystem::rename(in("b.db"), in("a.db"));
  const std::string sentence = test::refusalOf<DatasetError>([&] { writer.finish(); });
  EXPECT_NE(sentence.find("5 steps are not in it"), std::string::npos) << sentence;
  EXPECT_EQ(stepCount(readDataset(in("a.db"))), kMostWaiting + 1);
}

}  // namespace
}  // namespace lstm_planner::test_dataset_durability
