#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/harness.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/dataset/dataset_check.hpp"
#include "lstm_planner/dataset/drive_recorder.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner::fuzz {

/// The bytes of a dataset of one short drive, with scans.
inline std::string soundDataset() {
  RecordingSink sink{RecordingDescription{{}, softwareVersion(), "live", "odom", "2026-11-21T12:00:00Z"}};
  DriveRecorder recorder({}, &sink, [](const std::string&, double) { return std::optional<Pose2>(Pose2()); });
  recorder.add(GoalHeard{1000.0, {"odom", {3.0, 0.5, 0.0}}, "fuzz"});
  LaserScan scan{0.0, -M_PI_2, M_PI / 15.0, 0.1, 30.0, std::vector<float>(16, 2.5f)};
  for (int i = 0; i < 30; ++i) {
    const double stamp = 1000.0 + 0.1 * i;
    recorder.add(OdometryHeard{stamp, {0.03 * i, 0.0, 0.0}, {0.3, 0.0}});
    scan.stamp = stamp;
    recorder.add(ScanHeard{stamp, scan, {}, "laser"});
  }
  recorder.finish();
  sink.recording().finished = true;
  require(sink.recording().episodes.size() == 1 && !sink.recording().episodes[0].steps.empty(), "the drive has steps");

  const test::ScratchFolder folder;
  writeDataset(folder / "dataset", {{sink.recording()}});
  return folder.read("dataset");
}

inline void checkRecording(const Recording& recording) {
  const auto actions = static_cast<int>(recording.description.parameters.action_angles.size());
  for (const RecordedEpisode& episode : recording.episodes) {
    for (const DriveStep& step : episode.steps) {
      require(isFinite(step.pose) && isFinite(step.next_pose) && std::isfinite(step.driven_angle),
              "steps without a fault are finite");
      require(step.label >= 0 && step.label < actions, "labels without a fault are allowed angles");
    }
  }
}

/// Reads a dataset file: to find contradictions, with scans, and without. What can be read and holds no contradiction
/// is finite. `reader` % 4: one of these three, or for 0 all of them, which takes twice as long.
inline void readDatasetFile(const std::string& path, int reader) {
  const auto asks = [reader](int number) { return reader % 4 == 0 || reader % 4 == number; };
  if (asks(1)) expectRefusal<DatasetError>([&] { checkDatasetFile(path); });
  if (asks(2)) {
    expectRefusal<DatasetError>([&] {
      const Dataset dataset = readDataset(path, true);
      if (!checkDataset(dataset).empty()) return;
      for (const Recording& recording : dataset.recordings) checkRecording(recording);
    });
  }
  if (asks(3)) expectRefusal<DatasetError>([&] { readDataset(path, false); });
}

}  // namespace lstm_planner::fuzz
