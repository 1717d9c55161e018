#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/common/communicator.hpp"
#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// A training in steps that are short enough for a stop to wait for the end of one.
class SteppedTraining {
 public:
  virtual ~SteppedTraining() = default;

  virtual bool done() const = 0;
  virtual void step() = 0;

  /// The network as it is to be judged now.
  virtual const LayerStack& layers() const = 0;
  /// Whether it is time for that.
  virtual bool judgementDue() const = 0;

  /// Whether there is a checkpoint to go on from here.
  virtual bool resumable() const { return true; }
  /// Everything that the next step depends on.
  virtual std::vector<std::uint8_t> checkpoint() const = 0;
  /// Throws std::invalid_argument when it is not a checkpoint of the same training.
  virtual void restore(const std::vector<std::uint8_t>& checkpoint) = 0;
};

/// What came of judging a network.
struct Judgement {
  double score = 0.0;
  bool best = false;  ///< better than all before
  bool due = true;    ///< false: only because of a stop
};

/// Who has a training run: says how good its network is, keeps it, tells people, and stops it.
class TrainingHost {
 public:
  virtual ~TrainingHost() = default;

  /// Once, before the first step and behind what the checkpoint brought, if there was one.
  virtual void started(bool resumed) = 0;
  virtual void stepDone() = 0;
  /// Asked after every step. Of several ranks, all have to answer alike.
  virtual bool stopWanted() = 0;

  /// More is better.
  virtual double judge(const LayerStack& layers) = 0;
  /// Writes what was judged last to the output file; on the first rank only.
  virtual void keep(const LayerStack& layers) = 0;
  virtual void judged(const Judgement& judgement) = 0;

  /// An object with what the host adds to the checkpoint's progress, and takes from it.
  virtual nlohmann::json notes() const { return nlohmann::json::object(); }
  virtual void restoreNotes(const nlohmann::json& /*progress*/) {}
};

/// Which files a training writes, and when.
struct TrainingLoopOptions {
  std::string checkpoint;                     ///< file to go on from, where it exists, and to write; empty: none
  nlohmann::json settings;                    ///< what the result depends on besides; see TrainingCheckpoint
  std::string output;                         ///< the file to which the host keeps networks
  bool keep_last = false;                     ///< the network at the end is kept, whatever its score
  bool keep_later = false;                    ///< of networks with the same score, the later one is kept
  double checkpoint_interval = 5.0;           ///< s; between those that are neither due to a judgement nor to a stop
  Communicator* communicator = oneProcess();  ///< ranks that train together: the first writes the files
};

/// How a training ended.
struct TrainingOutcome {
  bool stopped = false;
  std::optional<double> best;  ///< score of the network in the output file
};

/// Trains until the training is done or the host wants a stop, which takes effect after the step. The network is judged
/// whenever that is due, and the best is kept; what a stop leaves is judged only where nothing else is kept. Goes on
/// from the checkpoint as if there had been no stop; the best so far counts unless its file is gone or is to be
/// another. Throws as readTrainingCheckpoint() and writeTrainingCheckpoint(), and what training and host throw.
TrainingOutcome runTraining(const TrainingLoopOptions& options, SteppedTraining* training, TrainingHost* host);

}  // namespace lstm_planner
