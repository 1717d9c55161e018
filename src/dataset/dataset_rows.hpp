#pragma once

#include <Poco/Data/LOB.h>
#include <Poco/Data/Statement.h>
#include <Poco/Nullable.h>

#include <array>
#include <optional>

#include "dataset/dataset_file.hpp"
#include "lstm_planner/dataset/drive_step.hpp"

namespace lstm_planner {

/// A row of table steps, as Poco binds it: statements keep references to the members.
struct StepRow {
  Poco::Int64 id = 0;
  Poco::Int64 episode = 0;
  Poco::Int64 geometry = 0;
  Poco::Int64 number = 0;
  DriveStep step;  ///< without number, geometry, ranges and minimum_ranges
  std::array<Poco::Nullable<double>, kSectorCount> minimum_ranges;  ///< null where there is none
};

/// Writes the rows of a dataset, inside transactions of the caller. Numbers of recordings and episodes are the
/// caller's.
class DatasetRows {
 public:
  /// `file` must outlive the object.
  explicit DatasetRows(DatasetFile* file) : file_(file) {}
  DatasetRows(const DatasetRows&) = delete;
  DatasetRows& operator=(const DatasetRows&) = delete;

  void addRecording(long id, const RecordingDescription& description);
  void finishRecording(long id);
  void setRejections(long recording, const RejectionCounts& counts);
  void addEpisode(long id, long recording, const Episode& episode);
  void endEpisode(long id, double stamp, EpisodeEnd end);
  void discardEpisode(long id);
  void addStep(long episode, const DriveStep& step);

 private:
  Poco::Int64 geometryOf(const DriveStep& step);

  DatasetFile* file_;
  StepRow row_;
  std::optional<Poco::Data::Statement> insert_step_;
  std::optional<ScanGeometry> last_geometry_;
  Poco::Int64 last_geometry_id_ = 0;
};

/// The numbers that the next recording and the next episode of a file get.
long nextRecording(DatasetFile* file);
long nextEpisode(DatasetFile* file);

/// Reads everything, inside a transaction of the caller.
Dataset readRows(DatasetFile* file, bool with_scans);

}  // namespace lstm_planner
