#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_imitation.hpp"

namespace lstm_planner {

/// One structure that the thesis tried (3.2): LSTM layers of the same number of cells, and the time sequence.
struct StructureTrial {
  int stage = 1;  ///< of the thesis's procedure: 1 is Figure 3.7, 2 to 4 are Tables 3.3 to 3.5
  int layers = 1;
  int cells = 4;  ///< of each layer
  int sequence_steps = 512;
  std::optional<double> thesis_accuracy;  ///< as printed there, share; Figure 3.7 prints no numbers

  std::string structure() const;  ///< as in the thesis: "1 LSTM layer - 4 cells"
};

/// All trials of the thesis, stage by stage.
std::vector<StructureTrial> thesisTrials();

/// Result of a trial at its best epoch on the validation set.
struct StructureOutcome {
  StructureTrial trial;
  std::size_t weights = 0;
  double training_accuracy = 0.0;  ///< share, as the next one
  double validation_accuracy = 0.0;
  int best_epoch = 0;
};

/// Trains every structure on the same paths, `parameters.threads` structures at a time. As in the thesis, an update is
/// a time sequence: parameters.batch_steps has no effect. Calls `progress` with the share that is done, from several
/// threads, one at a time; if it returns false, the search ends. Structures whose training was not started or not
/// finished are left out. The same for any number of threads. Throws as gridImitation().
std::vector<StructureOutcome> searchGridStructures(const GridImitationParameters& parameters,
                                                   const std::vector<StructureTrial>& trials,
                                                   const std::vector<GridCourse::Set>& training,
                                                   const std::vector<GridCourse::Set>& validation,
                                                   const std::function<bool(double)>& progress = {});

/// A Markdown table for each stage, with the thesis's accuracies beside the outcomes.
std::string structureTables(const std::vector<StructureOutcome>& outcomes);

/// One line for each outcome: stage, layers, cells, weights, sequence_steps, thesis_accuracy (empty if the thesis
/// prints none), validation_accuracy, training_accuracy, best_epoch.
std::string structureCsv(const std::vector<StructureOutcome>& outcomes);

}  // namespace lstm_planner
