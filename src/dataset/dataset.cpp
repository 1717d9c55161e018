#include "lstm_planner/dataset/dataset.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "dataset/dataset_file.hpp"
#include "dataset/dataset_row_check.hpp"
#include "dataset/dataset_rows.hpp"

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
      rows.addEpisode(++episode_id, recording_id, episode.episode);
      for (const DriveStep& step : episode.steps) {
        checkRow(step, recording.description.parameters.action_angles.size());
        rows.addStep(episode_id, step);
      }
    }
    if (recording.finished) rows.finishRecording(recording_id);
  }
}

[[noreturn]] void refuseExisting(const std::string& path) {
  throw DatasetError("dataset '" + path + "' cannot be written: there is such a file already");
}

}  // namespace

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
  std::error_code unknown;
  if (std::filesystem::exists(path, unknown)) refuseExisting(path);
  const std::string partial = path + ".partial-" + std::to_string(::getpid());
  try {
    {
      DatasetFile file(partial, DatasetFile::Use::kCreate, kPatience);
      file.transact([&] { writeRows(dataset, &file); });
    }
    // Unlike a renaming, a link does not replace what somebody has put there meanwhile.
    if (::link(partial.c_str(), path.c_str()) != 0) {
      if (errno == EEXIST) refuseExisting(path);
      std::filesystem::rename(partial, path);  // on file systems without links, as on most USB sticks
    }
    std::filesystem::remove(partial, unknown);
  } catch (const std::exception& error) {
    std::filesystem::remove(partial, unknown);
    std::filesystem::remove(partial + "-journal", unknown);
    const auto* known = dynamic_cast<const DatasetError*>(&error);
    if (known == nullptr) throw DatasetError("dataset '" + path + "' cannot be written: " + error.what());
    throw;
  }
}

}  // namespace lstm_planner
