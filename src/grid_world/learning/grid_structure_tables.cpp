#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <sstream>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/markdown_table.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/grid_world/learning/grid_structure_search.hpp"

namespace lstm_planner {
namespace {

constexpr std::array<const char*, 4> kStages = {
    "First stage: the time sequence (thesis Fig. 3.7, which prints no numbers for 128 and 256 steps)",
    "Second stage (thesis Table 3.3)", "Third stage (thesis Table 3.4)", "Fourth stage (thesis Table 3.5)"};

/// Table 3.3 repeats the first stage's structure at its time sequences.
bool belongsTo(const StructureTrial& trial, int stage) {
  return trial.stage == stage || (stage == 2 && trial.stage == 1 && trial.sequence_steps >= 512);
}

void writeTable(const std::vector<StructureOutcome>& outcomes, int stage, std::ostream& out) {
  std::set<int> times;
  std::vector<std::string> structures;
  for (const StructureOutcome& outcome : outcomes) {
    if (!belongsTo(outcome.trial, stage)) continue;
    times.insert(outcome.trial.sequence_steps);
    const std::string structure = outcome.trial.structure();
    if (std::find(structures.begin(), structures.end(), structure) == structures.end()) structures.push_back(structure);
  }
  if (structures.empty()) return;
  out << "\n" << kStages[static_cast<std::size_t>(stage - 1)] << "\n\n";
  std::vector<std::string> headings = {"structure", "weights"};
  for (const int time : times) {
    headings.push_back(std::to_string(time) + " steps, thesis");
    headings.push_back(std::to_string(time) + " steps, here");
  }
  MarkdownTable table(headings, &out);
  for (const std::string& structure : structures) {
    const auto find = [&](int time) {
      return std::find_if(outcomes.begin(), outcomes.end(), [&](const StructureOutcome& outcome) {
        return outcome.trial.structure() == structure && (time == 0 || outcome.trial.sequence_steps == time);
      });
    };
    std::vector<std::string> cells = {structure, std::to_string(find(0)->weights)};
    for (const int time : times) {
      const auto found = find(time);
      const bool printed = found != outcomes.end() && found->trial.thesis_accuracy;
      cells.push_back(printed ? percentText(*found->trial.thesis_accuracy, 2) : "-");
      cells.push_back(found != outcomes.end() ? percentText(found->validation_accuracy, 2) : "-");
    }
    table.row(cells);
  }
}

}  // namespace

std::string structureTables(const std::vector<StructureOutcome>& outcomes) {
  std::ostringstream out;
  out << "Validation accuracy\n";
  for (int stage = 1; stage <= static_cast<int>(kStages.size()); ++stage) writeTable(outcomes, stage, out);
  return out.str();
}

std::string structureCsv(const std::vector<StructureOutcome>& outcomes) {
  std::ostringstream out;
  CsvWriter csv(&out);
  csv.row("stage", "layers", "cells", "weights", "sequence_steps", "thesis_accuracy", "validation_accuracy",
          "training_accuracy", "best_epoch");
  for (const StructureOutcome& outcome : outcomes) {
    const StructureTrial& trial = outcome.trial;
    csv.row(trial.stage, trial.layers, trial.cells, outcome.weights, trial.sequence_steps,
            trial.thesis_accuracy.value_or(std::numeric_limits<double>::quiet_NaN()), outcome.validation_accuracy,
            outcome.training_accuracy, outcome.best_epoch);
  }
  return out.str();
}

}  // namespace lstm_planner
