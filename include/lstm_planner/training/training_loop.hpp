#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// A training in steps. They are short enough that a stop can wait for the end of one.
class SteppedTraining {
 public:
  virtual ~SteppedTraining() = default;

  virtual bool done() const = 0;
  virtual void step() = 0;

  /// The network that a judgement would judge now.
  virtual const LayerStack& layers() const = 0;
  /// Whether it is time for a judgement.
  virtual bool judgementDue() const = 0;

  /// Whether a checkpoint can be made now.
  virtual bool resumable() const { return true; }
  /// Everything that the next step depends on.
  virtual std::vector<std::uint8_t> checkpoint() const = 0;
  /// Throws std::invalid_argument if it is not a checkpoint of the same training.
  virtual void restore(const std::vector<std::uint8_t>& checkpoint) = 0;
};

/// Result of judging a network.
struct Judgement {
  double score = 0.0;
  bool best = false;  ///< better than all earlier ones
  bool due = true;    ///< false: it was judged only because of a stop
};

/// The side that runs a training: judges its network, keeps it, reports, and stops the training.
class TrainingHost {
 public:
  virtual ~TrainingHost() = default;

  /// Called once before the first step, after the checkpoint was read, if there was one.
  virtual void started(bool resumed) = 0;
  virtual void stepDone() = 0;
  /// Called after every step.
  virtual bool stopWanted() = 0;

  /// The network's score; a higher one is better.
  virtual double judge(const LayerStack& layers) = 0;
  /// Writes the network that was judged last to the output file.
  virtual void keep(const LayerStack& layers) = 0;
  virtual void judged(const Judgement& judgement) = 0;

  /// An object that the host adds to the progress in the checkpoint; restoreNotes() gets it back.
  virtual nlohmann::json notes() const { return nlohmann::json::object(); }
  virtual void restoreNotes(const nlohmann::json& /*progress*/) {}
};

/// Which files a training writes, and when.
struct TrainingLoopOptions {
  std::string checkpoint;  ///< file to write, and to continue from if it exists; empty: none
  /// An object with what else the result depends on (shape, maps, seed ...): a training with other settings cannot
  /// continue from the checkpoint.
  nlohmann::json settings = nlohmann::json::object();
  std::string output;                ///< the file to which the host writes networks
  bool keep_last = false;            ///< the network at the end is kept, with any score
  bool keep_later = false;           ///< of networks with the same score, the later one is kept
  double checkpoint_interval = 5.0;  ///< s between checkpoints; a judgement and a stop write one at once
};

/// How a training ended.
struct TrainingOutcome {
  bool stopped = false;
  std::optional<double> best;  ///< score of the network in the output file
};

/// Trains until the training is done, or until the host wants a stop, which takes effect after the step. The network is
/// judged whenever that is due, and the best is kept. At a stop it is judged, too, if there is no checkpoint or no
/// network was kept before. Continues from the checkpoint as if there had been no stop; the best score so far counts
/// unless its output file is gone or has another name now. Throws std::invalid_argument for a file that is not a
/// checkpoint, is truncated, or was made with other settings; std::runtime_error when none can be written; and what
/// training and host throw.
TrainingOutcome runTraining(const TrainingLoopOptions& options, SteppedTraining* training, TrainingHost* host);

}  // namespace lstm_planner
