#include "lstm_planner/training/training_loop.hpp"

#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "training/training_checkpoint.hpp"

namespace lstm_planner {
namespace {

using Clock = std::chrono::steady_clock;

class TrainingLoop {
 public:
  TrainingLoop(const TrainingLoopOptions& options, SteppedTraining* training, TrainingHost* host)
      : options_(options), training_(*training), host_(*host) {}

  TrainingOutcome run() {
    host_.started(restore());
    if (training_.judgementDue() && (!best_ || isLast())) judge(true);
    bool stopped = false;
    while (!training_.done() && !stopped) {
      training_.step();
      host_.stepDone();
      stopped = host_.stopWanted() && !training_.done();
      const bool due = training_.judgementDue();
      if (due) judge(true);
      // Without the stop nothing would have been judged here: what goes on from the checkpoint does not compare with
      // it.
      const std::optional<double> best_when_due = best_;
      if (!due && stopped && !isAnythingKept()) judge(false);
      writeCheckpoint(due || stopped, best_when_due);
    }
    return {stopped, best_};
  }

 private:
  /// The best of several judgements owes something to luck; the last network owes nothing to it.
  bool isLast() const { return options_.keep_last && training_.done(); }
  bool isAnythingKept() const { return !options_.checkpoint.empty() && best_; }

  void judge(bool due) {
    const double score = host_.judge(training_.layers());
    const bool best = !best_ || score > *best_ || (options_.keep_later && score == *best_);
    if (best || isLast()) {
      best_ = score;
      host_.keep(training_.layers());
    }
    host_.judged({score, best, due});
  }

  bool restore() {
    if (options_.checkpoint.empty()) return false;
    const auto checkpoint = readTrainingCheckpoint(options_.checkpoint, options_.settings);
    if (!checkpoint) return false;
    training_.restore(checkpoint->learner);
    try {
      const nlohmann::json& progress = checkpoint->progress;
      const nlohmann::json output = asInCheckpoint(options_.output);
      const bool same = progress.value("output", output) == output;
      if (same && progress.contains("best") && std::filesystem::exists(options_.output)) {
        best_ = progress["best"].get<double>();
      }
      host_.restoreNotes(progress);
    } catch (const nlohmann::json::exception& error) {
      throw std::invalid_argument("the progress in checkpoint '" + options_.checkpoint +
                                  "' is not that of a training: " + error.what());
    }
    return true;
  }

  void writeCheckpoint(bool at_once, const std::optional<double>& best) {
    if (options_.checkpoint.empty() || !training_.resumable()) return;
    const Clock::time_point now = Clock::now();
    if (!at_once && std::chrono::duration<double>(now - last_checkpoint_).count() < options_.checkpoint_interval) {
      return;
    }
    last_checkpoint_ = now;
    nlohmann::json progress = host_.notes();
    progress["output"] = options_.output;
    if (best) progress["best"] = *best;
    writeTrainingCheckpoint(options_.checkpoint, {options_.settings, progress, training_.checkpoint()});
  }

  const TrainingLoopOptions& options_;
  SteppedTraining& training_;
  TrainingHost& host_;
  std::optional<double> best_;
  Clock::time_point last_checkpoint_;
};

}  // namespace

TrainingOutcome runTraining(const TrainingLoopOptions& options, SteppedTraining* training, TrainingHost* host) {
  return TrainingLoop(options, training, host).run();
}

}  // namespace lstm_planner
