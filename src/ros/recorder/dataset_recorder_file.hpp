#pragma once

#include <optional>
#include <string>

#include "lstm_planner/dataset/dataset_writer.hpp"
#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"
#include "ros/recorder/dataset_recorder_status.hpp"

namespace lstm_planner {

/// The file that the node writes. It is made when the odometry's frame is known, since that is part of its description.
class RecorderFile {
 public:
  /// Makes the folder where there is none. Throws DatasetError when it cannot be made or is not to be written in.
  explicit RecorderFile(const RecorderNodeParameters& parameters);

  /// Makes the file, and has `progress` passed on to it. Throws DatasetError.
  void open(const std::string& odometry_frame, RecordingProgress* progress);
  bool isOpen() const { return writer_.has_value(); }

  /// See DatasetWriter; false, or nothing to do, while it is not open. finish() throws DatasetError.
  bool discardEpisode() { return writer_ && writer_->discardEpisode(); }
  void finish();

  /// Fills what it knows of: the file and its disk.
  void describe(RecordingStatus* status) const;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  RecorderParameters parameters_;
  std::optional<DatasetWriter> writer_;
};

}  // namespace lstm_planner
