#pragma once

#include <string>
#include <vector>

#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/imitation_rounds.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/training_loop.hpp"
#include "tools/command_line.hpp"
#include "tools/progress.hpp"

namespace lstm_planner {

/// Runs a training from the command line: Ctrl-C stops it, a bar shows how far it is.
class ToolTrainingHost : public TrainingHost {
 public:
  /// `options` must outlive it.
  explicit ToolTrainingHost(const TrainingLoopOptions& options) : options_(options) {}

  void started(bool resumed) final;
  void stepDone() override { showProgress(progress()); }
  bool stopWanted() final { return interruption_.wanted(); }

  /// Says what was written and, after a stop, how it goes on. Returns the exit status.
  int end(const TrainingOutcome& outcome) const;

 protected:
  void showProgress(double share) { bar_.show(share); }

  virtual double progress() const = 0;                    ///< share of the training that is done
  virtual std::string position() const = 0;               ///< what is done, like "iteration 5"
  virtual std::string scoreText(double score) const = 0;  ///< of the network that was written
  virtual void printHeader() const = 0;                   ///< of the table of steps
  /// How a stopped training with a checkpoint is gone on with.
  virtual std::string resumption() const { return "the same command continues from here"; }

 private:
  const TrainingLoopOptions& options_;
  Interruption interruption_;
  Progress bar_;
};

/// How far an imitation is: "2 rounds and 5 epochs".
std::string positionOf(const ImitationRounds& rounds);

// Options of each way of training. `shape` and `loss` must stay where they are until the line is parsed.

/// Layers, and the thesis's alternatives inside a layer. `mlp_units`: of each layer of a perceptron, where nothing else
/// is said.
void addShapeOptions(NetworkShape* shape, const std::vector<int>& mlp_units, CommandLine* line);
/// Throws std::invalid_argument where one of these options, or another of `decided`, was given beside the option `from`
/// of a model, which decides them.
void checkModelDecides(const CommandLine& line, const std::string& from, std::vector<std::string> decided = {});
void addLossOption(Loss* loss, CommandLine* line);

}  // namespace lstm_planner
