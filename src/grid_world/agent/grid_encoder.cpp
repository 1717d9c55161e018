#include "lstm_planner/grid_world/agent/grid_encoder.hpp"

#include <cmath>
#include <stdexcept>

namespace lstm_planner {
namespace {

/// Cells; distances up to this one are told apart best (thesis: plain division by a scale).
constexpr float kDistanceScale = 100.0f;

}  // namespace

void encodeGrid(const GridObservation& observation, int previous_direction, float* input, int stride) {
  const auto put = [&](float value) {
    *input = value;
    input += stride;
  };
  for (const auto range : observation.ranges) put(static_cast<float>(range) / static_cast<float>(kGridRayCap));
  const float columns = static_cast<float>(observation.goal.column - observation.cell.column);
  const float rows = static_cast<float>(observation.goal.row - observation.cell.row);
  const float distance = std::hypot(columns, rows);
  put(distance / (distance + kDistanceScale));
  // Of the unit vector, as where the shipped networks learned: the last bit may differ.
  const float unit = distance > 0.0f ? distance : 1.0f;
  put(std::atan2(rows / unit, columns / unit) / static_cast<float>(M_PI));
  put(previous_direction == kNoPath ? 0.0f : static_cast<float>(previous_direction) / 4.0f - 1.0f);
}

void writeGridMetadata(std::map<std::string, std::string>* metadata) { (*metadata)["grid_inputs"] = "thesis"; }

void checkGridMetadata(const std::map<std::string, std::string>& metadata) {
  const auto inputs = metadata.find("grid_inputs");
  if (inputs == metadata.end()) {
    throw std::invalid_argument("the model has no grid_inputs, expected one made for the grid world");
  }
  if (inputs->second != "thesis") {
    throw std::invalid_argument("grid_inputs is '" + inputs->second + "', expected thesis");
  }
}

void checkGridNetwork(const LayerStack& layers) {
  const int inputs = inputSize(layers);
  const int outputs = outputSize(layers);
  if (inputs == kGridInputs && outputs == kGridMoveCount) return;
  throw std::invalid_argument("the network has " + std::to_string(inputs) + " inputs and " + std::to_string(outputs) +
                              " outputs, expected " + std::to_string(kGridInputs) + " and " +
                              std::to_string(kGridMoveCount));
}

}  // namespace lstm_planner
