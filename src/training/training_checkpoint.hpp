#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lstm_planner {

/// A training that can be gone on with as if it had never stopped.
struct TrainingCheckpoint {
  /// What the result depends on besides: method, shape, maps, seed ... A training with others cannot go on from here.
  nlohmann::json settings;
  nlohmann::json progress;            ///< how far it is, for people and for the command
  std::vector<std::uint8_t> learner;  ///< weights, optimisers and whatever else the learner needs
};

/// What is read again of settings or progress: letters that are no UTF-8, as in names of files, are replaced.
nlohmann::json asInCheckpoint(const nlohmann::json& json);

/// Replaces the file only when the new one is complete. Throws std::runtime_error when it cannot be written.
void writeTrainingCheckpoint(const std::string& path, const TrainingCheckpoint& checkpoint);

/// Empty when there is no such file. Throws std::invalid_argument when it is not a checkpoint, is truncated, or was
/// made with other settings, naming the first that differs.
std::optional<TrainingCheckpoint> readTrainingCheckpoint(const std::string& path, const nlohmann::json& settings);

}  // namespace lstm_planner
