#pragma once

#include <memory>
#include <string>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// Writes a recording into a dataset file, step by step. If the file exists, the recording is added to it.
///
/// Each call is a transaction that is on the disk when it returns: after a crash, kill -9 or a power cut the file holds
/// everything up to some call. What cannot be written (a full disk, a reader who has the file locked for longer than
/// 0.1 s, a file that was moved away) is kept in memory, up to 10,000 steps, and tried again with the next call, in
/// order; problem() says so. The file may be read at any time. PATH.lock beside it keeps other writers away.
///
/// The calls of StepSink throw only for errors that no recorder makes: std::logic_error for a step or an end without an
/// episode, or after finish(); std::invalid_argument for a step whose number does not increase in its episode, and for
/// a step, scan or episode that readDataset() would refuse. Not thread safe.
class DatasetWriter : public StepSink {
 public:
  /// Throws DatasetError if the file cannot be made, is not a dataset, or is open in another writer.
  DatasetWriter(const std::string& path, const RecordingDescription& description);
  /// Finishes, if finish() was not called; never throws. What cannot be written then is lost.
  ~DatasetWriter() override;
  DatasetWriter(const DatasetWriter&) = delete;
  DatasetWriter& operator=(const DatasetWriter&) = delete;

  void startEpisode(const Episode& episode) override;
  void addStep(const DriveStep& step) override;
  void endEpisode(double stamp, EpisodeEnd end) override;
  /// Counted in memory; written with the next call of another function.
  void reject(Rejection rejection) override;

  /// Discards the last episode that is not discarded yet, so that nothing is learned from it. False if there is none.
  bool discardEpisode();

  /// Writes what is waiting, marks the recording as finished and closes the file. Throws DatasetError saying how many
  /// steps are missing; if they still wait, it can be called again.
  void finish();

  long stored() const;                 ///< steps that are on the disk
  long waiting() const;                ///< steps that could not be written yet
  long lost() const;                   ///< steps that were given up because too many were waiting
  const std::string& problem() const;  ///< why steps are waiting; empty if none are

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lstm_planner
