#pragma once

#include <unistd.h>

#include <ctime>
#include <filesystem>
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
  explicit RecorderFile(const RecorderNodeParameters& parameters)
      : path_(outputPath(parameters.output, std::time(nullptr))), parameters_(parameters.recorder) {
    const std::filesystem::path folder = folderOf(path_);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw DatasetError("cannot make the folder of " + path_ + ": " + error.message());
    if (access(folder.c_str(), W_OK) != 0) {
      throw DatasetError("cannot write " + path_ + ": its folder is not writable");
    }
  }

  /// Makes the file, and has `progress` passed on to it. Throws DatasetError.
  void open(const std::string& odometry_frame, RecordingProgress* progress) {
    RecordingDescription description;
    description.parameters = parameters_;
    description.source = "live";
    description.odometry_frame = odometry_frame;
    description.begun = utcTime(static_cast<double>(std::time(nullptr)));
    writer_.emplace(path_, description);
    progress->passTo(&*writer_);
  }
  bool isOpen() const { return writer_.has_value(); }

  /// See DatasetWriter; false, or nothing to do, while it is not open. finish() throws DatasetError.
  bool discardEpisode() { return writer_ && writer_->discardEpisode(); }
  void finish() {
    if (writer_) writer_->finish();
  }

  /// Fills what it knows of: the file and its disk.
  void describe(RecordingStatus* status) const {
    status->file = path_;
    if (writer_) {
      status->stored = writer_->stored();
      status->waiting = writer_->waiting();
      status->lost = writer_->lost();
      status->write_problem = writer_->problem();
    }
    std::error_code error;
    const auto space = std::filesystem::space(folderOf(path_), error);
    if (!error) status->disk_left = static_cast<double>(space.available) * 1e-6;
  }
  const std::string& path() const { return path_; }

 private:
  static std::filesystem::path folderOf(const std::string& path) {
    return std::filesystem::absolute(path).parent_path();
  }

  std::string path_;
  RecorderParameters parameters_;
  std::optional<DatasetWriter> writer_;
};

}  // namespace lstm_planner
