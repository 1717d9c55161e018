#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"

namespace lstm_planner {

/// A dataset file that cannot be read or written; what() is one sentence with the path and the reason.
class DatasetError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The version of this package, e.g. "0.2.0".
std::string softwareVersion();

/// What holds for all steps of a recording.
struct RecordingDescription {
  RecorderParameters parameters;
  std::string software_version = softwareVersion();
  std::string source;          ///< "live", or the path of the bag or log
  std::string odometry_frame;  ///< may be empty where there are no frames
  std::string begun;           ///< UTC, ISO 8601, by the computer's clock
};

/// A time as text, in the format of RecordingDescription::begun.
std::string utcTime(double seconds_since_1970);

/// A drive to one goal, with its steps.
struct RecordedEpisode {
  Episode episode;
  std::vector<DriveStep> steps;
};

/// What one run of a recorder wrote.
struct Recording {
  RecordingDescription description;
  bool finished = false;  ///< false: it is still going on, or was cut off
  RejectionCounts rejections{};
  std::vector<RecordedEpisode> episodes;
};

/// Keeps a recording in memory.
class RecordingSink : public StepSink {
 public:
  explicit RecordingSink(const RecordingDescription& description) { recording_.description = description; }

  void startEpisode(const Episode& episode) override { recording_.episodes.push_back({episode, {}}); }
  void addStep(const DriveStep& step) override { recording_.episodes.back().steps.push_back(step); }
  void endEpisode(double stamp, EpisodeEnd end) override {
    recording_.episodes.back().episode.ended = stamp;
    recording_.episodes.back().episode.end = end;
  }
  void reject(Rejection rejection) override { ++recording_.rejections[static_cast<std::size_t>(rejection)]; }

  Recording& recording() { return recording_; }
  const Recording& recording() const { return recording_; }

 private:
  Recording recording_;
};

/// What a dataset file holds: one recording, or several that were merged.
struct Dataset {
  std::vector<Recording> recordings;
};

long stepCount(const Dataset& dataset);  ///< without those of discarded episodes

/// Reads a whole dataset file (an SQLite database, `sqlite3 FILE .schema` explains it), also during a recording.
/// `with_scans`: also DriveStep::ranges. Throws DatasetError if the file does not exist, is not a dataset, is damaged,
/// has a newer schema, or has a row that no recorder writes: a value of another type than in the schema, a number that
/// is not finite or too large, a label without an angle, a scan of another length than in its geometry.
Dataset readDataset(const std::string& path, bool with_scans = false);

/// Writes a new file that appears complete or not at all. Throws DatasetError, also if the file exists already.
void writeDataset(const std::string& path, const Dataset& dataset);

}  // namespace lstm_planner
