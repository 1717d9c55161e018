#include "ros/recorder/dataset_recorder_file.hpp"

#include <unistd.h>

#include <ctime>
#include <filesystem>

namespace lstm_planner {

namespace {

std::filesystem::path folderOf(const std::string& path) { return std::filesystem::absolute(path).parent_path(); }

}  // namespace

RecorderFile::RecorderFile(const RecorderNodeParameters& parameters)
    : path_(outputPath(parameters.output, std::time(nullptr))), parameters_(parameters.recorder) {
  const std::filesystem::path folder = folderOf(path_);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw DatasetError("cannot make the folder of " + path_ + ": " + error.message());
  if (access(folder.c_str(), W_OK) != 0) {
    throw DatasetError("cannot write " + path_ + ": its folder is not writable");
  }
}

void RecorderFile::open(const std::string& odometry_frame, RecordingProgress* progress) {
  RecordingDescription description;
  description.parameters = parameters_;
  description.source = "live";
  description.odometry_frame = odometry_frame;
  description.begun = utcTime(static_cast<double>(std::time(nullptr)));
  writer_.emplace(path_, description);
  progress->passTo(&*writer_);
}

void RecorderFile::finish() {
  if (writer_) writer_->finish();
}

void RecorderFile::describe(RecordingStatus* status) const {
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

}  // namespace lstm_planner
