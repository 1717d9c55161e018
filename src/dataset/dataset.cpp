#include "lstm_planner/dataset/dataset.hpp"

#include <Poco/DateTimeFormatter.h>
#include <Poco/Timestamp.h>

#include <ctime>
#include <filesystem>
#include <system_error>

#include "dataset/dataset_file.hpp"
#include "dataset/dataset_rows.hpp"
#include "dataset/dataset_trust.hpp"
#include "lstm_planner/common/output_file.hpp"

namespace lstm_planner {

namespace {

constexpr int kPatience = 10000;  // ms; a writer has the file locked for some milliseconds at a time

void writeRows(const Dataset& dataset, DatasetFile* file) {
  DatasetRows rows(file);
  long recording_id = 0;
  long episode_id = 0;
  for (const Recording& recording : dataset.recordings) {
    rows.addRecording(++recording_id, recording.description);
    rows.setRejections(recording_id, recording.rejections);
    for (const RecordedEpisode& episode : recording.episodes) {
      checkRow(episode.episode);
      rows.addEpisode(++episode_id, recording_id, episode.episode);
      for (const DriveStep& step : episode.steps) {
        checkStepWithScan(step, recording.description.parameters.action_angles.size());
        rows.addStep(episode_id, step);
      }
    }
    if (recording.finished) rows.finishRecording(recording_id);
  }
}

}  // namespace

std::string softwareVersion() { return LSTM_PLANNER_VERSION; }

std::string utcTime(double seconds_since_1970) {
  const auto time = Poco::Timestamp::fromEpochTime(static_cast<std::time_t>(seconds_since_1970));
  return Poco::DateTimeFormatter::format(time, "%Y-%m-%dT%H:%M:%SZ");
}

long stepCount(const Dataset& dataset) {
  long count = 0;
  for (const Recording& recording : dataset.recordings) {
    for (const RecordedEpisode& episode : recording.episodes) {
      if (!episode.episode.discarded) count += static_cast<long>(episode.steps.size());
    }
  }
  return count;
}

Dataset readDataset(const std::string& path, bool with_scans) {
  DatasetFile file(path, DatasetFile::Use::kRead, kPatience);
  Dataset dataset;
  file.transact([&] { dataset = readRows(&file, with_scans); });
  return dataset;
}

void writeDataset(const std::string& path, const Dataset& dataset) {
  const std::string sentence = "dataset '" + path + "' cannot be written: ";
  std::error_code unknown;
  if (std::filesystem::exists(path, unknown)) throw DatasetError(sentence + "there is such a file already");
  try {
    OutputFile output(path, OutputFile::Existing::kRefuse);
    {
      DatasetFile file(output.partPath(), DatasetFile::Use::kCreate, kPatience, path);
      file.transact([&] { writeRows(dataset, &file); });
    }
    output.commit();
  } catch (const DatasetError&) {
    throw;
  } catch (const std::exception& error) {
    throw DatasetError(sentence + error.what());
  }
}

}  // namespace lstm_planner
