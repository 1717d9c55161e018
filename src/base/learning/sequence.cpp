#include "lstm_planner/base/learning/sequence.hpp"

#include <cmath>
#include <stdexcept>

namespace lstm_planner {
namespace {

[[noreturn]] void refuse(const std::string& name, std::size_t index, const std::string& reason) {
  throw std::invalid_argument(name + " sequence " + std::to_string(index) + ": " + reason);
}

}  // namespace

void validateSequences(const std::vector<Sequence>& sequences, int inputs, int outputs, const std::string& name) {
  for (std::size_t index = 0; index < sequences.size(); ++index) {
    const Sequence& sequence = sequences[index];
    const Eigen::Index steps = sequence.steps();
    if (steps == 0) refuse(name, index, "has no steps, expected at least one");
    if (sequence.inputs.rows() != inputs) {
      refuse(
          name, index,
          "has " + std::to_string(sequence.inputs.rows()) + " features, the network expects " + std::to_string(inputs));
    }
    if (sequence.labels.size() != steps || sequence.weights.size() != steps) {
      refuse(name, index,
             "has " + std::to_string(sequence.labels.size()) + " labels and " +
                 std::to_string(sequence.weights.size()) + " weights, expected " + std::to_string(steps) +
                 " of each, one a step");
    }
    if (!sequence.inputs.allFinite()) refuse(name, index, "has an input that is not finite");
    for (Eigen::Index step = 0; step < steps; ++step) {
      const float weight = sequence.weights[step];
      if (!std::isfinite(weight) || weight < 0.0f) {
        refuse(name, index,
               "has weight " + std::to_string(weight) + " at step " + std::to_string(step) +
                   ", expected a finite value of at least 0");
      }
      const int label = sequence.labels[step];
      if (weight > 0.0f && (label < 0 || label >= outputs)) {
        refuse(name, index,
               "has label " + std::to_string(label) + " at step " + std::to_string(step) + ", expected one in [0, " +
                   std::to_string(outputs) + ")");
      }
    }
  }
}

}  // namespace lstm_planner
