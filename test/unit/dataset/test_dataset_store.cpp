// Dataset files: what is written comes back, and what is none is refused with a sentence.

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>

#include "dataset/step_quantities.hpp"
#include "lstm_planner/dataset/dataset_check.hpp"
#include "lstm_planner/dataset/dataset_summary.hpp"
#include "lstm_planner/dataset/dataset_writer.hpp"
#include "support/refusal.hpp"
#include "unit/dataset/dataset_fixtures.hpp"

namespace lstm_planner::test_dataset_store {
namespace {

class DatasetStore : public DatasetTest {
 protected:
  /// The sentence with which reading a file is refused; empty when it is read.
  std::string refusal(const std::string& name) const {
    return test::refusalOf<DatasetError>([&] { readDataset(in(name)); });
  }
};

/// Bit for bit.
std::vector<double> numbersOf(const DriveStep& step) {
  std::vector<double> numbers = {static_cast<double>(step.number)};
  visitColumns(step, [&](const std::string&, const char*, const auto& number) { numbers.push_back(number); });
  return numbers;
}

void expectSame(const DriveStep& a, const DriveStep& b) {
  EXPECT_EQ(numbersOf(a), numbersOf(b)) << "step " << a.number;
  EXPECT_EQ(a.geometry, b.geometry);
  ASSERT_EQ(a.ranges.size(), b.ranges.size());
  EXPECT_EQ(std::memcmp(a.ranges.data(), b.ranges.data(), a.ranges.size() * sizeof(float)), 0);
}

void expectSame(const RecordedEpisode& a, const RecordedEpisode& b) {
  EXPECT_EQ(a.episode.goal.frame, b.episode.goal.frame);
  EXPECT_EQ(a.episode.goal.pose.x, b.episode.goal.pose.x);
  EXPECT_EQ(a.episode.goal.pose.y, b.episode.goal.pose.y);
  EXPECT_EQ(a.episode.goal.pose.yaw, b.episode.goal.pose.yaw);
  EXPECT_EQ(a.episode.goal_source, b.episode.goal_source);
  EXPECT_EQ(a.episode.begun, b.episode.begun);
  EXPECT_EQ(a.episode.ended, b.episode.ended);
  EXPECT_EQ(a.episode.end, b.episode.end);
  EXPECT_EQ(a.episode.discarded, b.episode.discarded);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) expectSame(a.steps[i], b.steps[i]);
}

void expectSame(const Recording& a, const Recording& b) {
  EXPECT_EQ(a.description.source, b.description.source);
  EXPECT_EQ(a.description.software_version, b.description.software_version);
  EXPECT_EQ(a.description.odometry_frame, b.description.odometry_frame);
  EXPECT_EQ(a.description.begun, b.description.begun);
  EXPECT_EQ(toJson(a.description.parameters), toJson(b.description.parameters));
  EXPECT_EQ(a.finished, b.finished);
  EXPECT_EQ(a.rejections, b.rejections);
  ASSERT_EQ(a.episodes.size(), b.episodes.size());
  for (std::size_t i = 0; i < a.episodes.size(); ++i) expectSame(a.episodes[i], b.episodes[i]);
}

void record(const Recording& recording, DatasetWriter* writer) {
  for (int reason = 0; reason < kRejectionCount; ++reason) {
    for (long i = 0; i < recording.rejections[static_cast<std::size_t>(reason)]; ++i) {
      writer->reject(static_cast<Rejection>(reason));
    }
  }
  for (const RecordedEpisode& episode : recording.episodes) {
    Episode begun = episode.episode;
    begun.ended = 0.0;
    begun.end = EpisodeEnd::kRunning;
    writer->startEpisode(begun);
    for (const DriveStep& step : episode.steps) writer->addStep(step);
    writer->endEpisode(episode.episode.ended, episode.episode.end);
  }
}

TEST_F(DatasetStore, GivesBackWhatWasRecordedBitForBit) {
  const Recording recording = exampleRecording(3, 1);
  {
    DatasetWriter writer(in("a.db"), recording.description);
    record(recording, &writer);
    EXPECT_EQ(writer.stored(), 4 + 5 + 6);
    EXPECT_EQ(writer.waiting(), 0);
    EXPECT_EQ(writer.problem(), "");
    EXPECT_FALSE(readDataset(in("a.db")).recordings.at(0).finished) << "read while it is being recorded";
    writer.finish();
  }
  const Dataset dataset = readDataset(in("a.db"), true);
  ASSERT_EQ(dataset.recordings.size(), 1u);
  expectSame(dataset.recordings[0], recording);
  EXPECT_EQ(stepCount(dataset), 15);
  EXPECT_FALSE(std::filesystem::exists(in("a.db.lock")));
  EXPECT_FALSE(std::filesystem::exists(in("a.db-journal"))) << "the file is the whole dataset";
}

TEST_F(DatasetStore, WritesAWholeDatasetAsARecorderWould) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(2, 1), exampleRecording(1, 2, "b.bag")};
  dataset.recordings[1].episodes[0].episode.discarded = true;
  dataset.recordings[1].finished = false;
  writeDataset(in("a.db"), dataset);
  const Dataset read = readDataset(in("a.db"), true);
  ASSERT_EQ(read.recordings.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) expectSame(read.recordings[i], dataset.recordings[i]);
  EXPECT_EQ(stepCount(read), 4 + 5) << "the discarded episode does not count";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1) << "nothing is left beside it";
}

TEST_F(DatasetStore, LeavesScansOutWhereNobodyAsksForThem) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(1, 1)};
  dataset.recordings[0].episodes[0].steps[1].ranges.clear();
  writeDataset(in("a.db"), dataset);
  EXPECT_TRUE(readDataset(in("a.db")).recordings[0].episodes[0].steps[0].ranges.empty());
  const Dataset read = readDataset(in("a.db"), true);
  EXPECT_EQ(read.recordings[0].episodes[0].steps[0].ranges.size(), 16u);
  EXPECT_TRUE(read.recordings[0].episodes[0].steps[1].ranges.empty());
}

TEST_F(DatasetStore, AddsARecordingToADatasetThatIsThere) {
  const Recording first = exampleRecording(2, 1);
  const Recording second = exampleRecording(1, 2);
  for (const Recording& recording : {first, second}) {
    DatasetWriter writer(in("a.db"), recording.description);
    record(recording, &writer);
  }
  const Dataset dataset = readDataset(in("a.db"), true);
  ASSERT_EQ(dataset.recordings.size(), 2u);
  expectSame(dataset.recordings[0], first);
  expectSame(dataset.recordings[1], second);
}

TEST_F(DatasetStore, DiscardsTheEpisodesThatWereBegunLast) {
  const Recording recording = exampleRecording(3, 1);
  {
    DatasetWriter writer(in("a.db"), recording.description);
    EXPECT_FALSE(writer.discardEpisode()) << "there is none";
    record(recording, &writer);
    EXPECT_TRUE(writer.discardEpisode());
    EXPECT_TRUE(writer.discardEpisode());
  }
  const Dataset dataset = readDataset(in("a.db"));
  const std::vector<RecordedEpisode>& episodes = dataset.recordings[0].episodes;
  EXPECT_FALSE(episodes[0].episode.discarded);
  EXPECT_TRUE(episodes[1].episode.discarded);
  EXPECT_TRUE(episodes[2].episode.discarded);
  EXPECT_EQ(stepCount(dataset), 4);
}

TEST_F(DatasetStore, RefusesAStepThatNoRecorderMakes) {
  DatasetWriter writer(in("a.db"), exampleDescription());
  const RecordedEpisode episode = exampleEpisode(2, 1);
  const auto refusal = [&](const DriveStep& step) {
    return test::refusalOf<std::logic_error>([&] { writer.addStep(step); });
  };
  const auto refusalOfEnd = [&](double stamp) {
    return test::refusalOf<std::logic_error>([&] { writer.endEpisode(stamp, EpisodeEnd::kArrived); });
  };
  EXPECT_EQ(refusal(episode.steps[0]), "a step was added before an episode was started");
  EXPECT_EQ(refusalOfEnd(1.0), "an episode was ended before one was started");
  writer.startEpisode(episode.episode);
  writer.addStep(episode.steps[0]);
  EXPECT_EQ(refusal(episode.steps[0]), "step 0 was added after step 0 of the same episode");
  DriveStep broken = episode.steps[1];
  broken.observation.goal_bearing = std::nan("");
  EXPECT_EQ(refusal(broken), "its goal_bearing is nan, expected a number from -1e+10 to 1e+10");
  broken = episode.steps[1];
  broken.label = 5;
  EXPECT_EQ(refusal(broken), "its label is 5, expected 0 to 4");
  broken = episode.steps[1];
  broken.geometry.beams = 1;
  EXPECT_EQ(refusal(broken), "its scan has 16 ranges, expected 1 as in its geometry");
  broken.ranges.clear();
  EXPECT_NE(refusal(broken).find("expected at least -87 to +87 degrees"), std::string::npos) << refusal(broken);
  broken = episode.steps[1];
  broken.measured[0] = -1;
  EXPECT_EQ(refusal(broken), "a sector has -1 beams, expected 0 or more");
  writer.addStep(episode.steps[1]);
  EXPECT_EQ(refusalOfEnd(std::nan("")), "its ended is nan, expected a number from -1e+10 to 1e+10");
  Episode nowhere = episode.episode;
  nowhere.goal.pose.yaw = std::nan("");
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { writer.startEpisode(nowhere); }),
            "its goal_yaw is nan, expected a number from -1e+10 to 1e+10");
  writer.finish();
  EXPECT_EQ(refusal(episode.steps[1]), "dataset '" + in("a.db") + "' is finished");
}

TEST_F(DatasetStore, WritesNoDatasetThatCouldNotBeReadAgain) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(1, 1)};
  dataset.recordings[0].episodes[0].steps[1].observation.goal_distance = 1.0 / 0.0;
  const std::string sentence = test::refusalOf<DatasetError>([&] { writeDataset(in("a.db"), dataset); });
  EXPECT_NE(sentence.find("its goal_distance is inf, expected a number"), std::string::npos) << sentence;
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(DatasetStore, NamesTheFileThatWasAskedForWhereTheDiskIsFull) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(20, 1)};
  const auto none = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit little = before;
  little.rlim_cur = 1 << 15;
  ::setrlimit(RLIMIT_FSIZE, &little);
  const std::string sentence = test::refusalOf<DatasetError>([&] { writeDataset(in("a.db"), dataset); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, none);
  EXPECT_EQ(sentence.rfind("dataset '" + in("a.db") + "' cannot be written: ", 0), 0u) << sentence;
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(DatasetStore, RefusesASecondWriterUntilTheFirstIsDone) {
  {
    DatasetWriter writer(in("a.db"), exampleDescription());
    EXPECT_EQ(test::refusalOf<DatasetError>([this] { DatasetWriter(in("a.db"), exampleDescription()); }),
              "dataset '" + in("a.db") + "' is being recorded by another writer");
    const RecordedEpisode episode = exampleEpisode(1, 1);
    writer.startEpisode(episode.episode);
    writer.addStep(episode.steps[0]);
    writer.finish();
    EXPECT_NO_THROW(DatasetWriter(in("a.db"), exampleDescription())) << "finished, so free";
  }
  EXPECT_EQ(readDataset(in("a.db")).recordings.size(), 2u);
}

TEST_F(DatasetStore, SaysWhatIsWrongWithAFileThatIsNoDataset) {
  std::ofstream(in("text.db")) << std::string(5000, 'x');
  std::ofstream(in("empty.db"));
  std::filesystem::create_directory(in("folder.db"));
  EXPECT_EQ(refusal("text.db"), "dataset '" + in("text.db") + "' cannot be read: file is not a database");
  EXPECT_EQ(refusal("empty.db"), "'" + in("empty.db") + "' is empty, expected a dataset");
  EXPECT_EQ(refusal("folder.db"), "dataset '" + in("folder.db") + "' cannot be read: it is a folder, expected a file");
  EXPECT_EQ(refusal("none.db"), "dataset '" + in("none.db") + "' cannot be read: there is no such file");
  EXPECT_FALSE(std::filesystem::exists(in("none.db"))) << "reading makes nothing";
  const auto refusalOfWriter = [&](const std::string& name) {
    return test::refusalOf<DatasetError>([&] { DatasetWriter(in(name), exampleDescription()); });
  };
  EXPECT_EQ(refusalOfWriter("text.db"), "dataset '" + in("text.db") + "' cannot be written: file is not a database");
  EXPECT_EQ(refusalOfWriter("nowhere/a.db"), "dataset '" + in("nowhere/a.db") + "' cannot be written: '" +
                                                 in("nowhere/a.db.lock") + "': No such file or directory");
  EXPECT_EQ(test::refusalOf<DatasetError>([&] { writeDataset(in("text.db"), {}); }),
            "dataset '" + in("text.db") + "' cannot be written: there is such a file already");
  EXPECT_EQ(std::filesystem::file_size(in("text.db")), 5000u);
}

/// Bytes 60 to 63 of an SQLite file are the user version, 68 to 71 the application's id, big-endian.
void setByte(const std::string& path, long place, char value) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(place);
  file.put(value);
}

TEST_F(DatasetStore, RefusesANewerSchemaAndOtherDatabases) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(1, 1)};
  for (const char* name : {"newer.db", "other.db"}) writeDataset(in(name), dataset);
  setByte(in("newer.db"), 63, 2);
  setByte(in("other.db"), 68, 'X');
  EXPECT_EQ(refusal("newer.db"),
            "dataset '" + in("newer.db") + "' has schema version 2, expected 1: it was made by a newer lstm_planner");
  EXPECT_EQ(refusal("other.db"), "'" + in("other.db") + "' is a database, but not a dataset of lstm_planner");
  EXPECT_EQ(test::refusalOf<DatasetError>([&] { DatasetWriter(in("newer.db"), exampleDescription()); }),
            refusal("newer.db"));
}

TEST_F(DatasetStore, SaysSoWhenAFileWasCutOffAnywhere) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(5, 1)};
  writeDataset(in("whole.db"), dataset);
  const auto length = static_cast<long>(std::filesystem::file_size(in("whole.db")));
  for (long cut = 1; cut < length; cut += 1021) {
    std::filesystem::copy_file(in("whole.db"), in("cut.db"), std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(in("cut.db"), static_cast<std::uintmax_t>(length - cut));
    const std::string sentence = refusal("cut.db");
    EXPECT_NE(sentence.find("cut.db'"), std::string::npos)
        << length - cut << " of " << length << " bytes: " << sentence;
  }
}

TEST_F(DatasetStore, ReadsOrRefusesAFileWithWrongBytes) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(3, 1)};
  writeDataset(in("whole.db"), dataset);
  const auto length = std::filesystem::file_size(in("whole.db"));
  Random random(7);
  int refused = 0;
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    std::filesystem::copy_file(in("whole.db"), in("a.db"), std::filesystem::copy_options::overwrite_existing);
    for (int k = 0; k < 20; ++k) {
      setByte(in("a.db"), static_cast<long>(uniformIndex(random, length)),
              static_cast<char>(uniformIndex(random, 256)));
    }
    refused += refusal("a.db").empty() ? 0 : 1;
    try {
      summarise(readDataset(in("a.db"), true));
      found += checkDatasetFile(in("a.db")).empty() ? 0 : 1;
    } catch (const DatasetError&) {
      // Nothing else may be thrown.
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(found, 0) << "of those that can be read";
}

}  // namespace
}  // namespace lstm_planner::test_dataset_store
