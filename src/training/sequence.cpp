#include "lstm_planner/training/sequence.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {
namespace {

[[noreturn]] void refuse(const std::string& name, std::size_t index, const std::string& reason) {
  throw std::invalid_argument(name + " sequence " + std::to_string(index) + ": " + reason);
}

}  // namespace

void cutIntoPieces(const Sequence& episode, const SequenceCut& cut, std::vector<Sequence>* pieces) {
  for (Eigen::Index fresh = 0; fresh < episode.steps(); fresh += fresh == 0 ? cut.first : cut.further) {
    const Eigen::Index length = fresh == 0 ? cut.first : cut.further;
    const Eigen::Index begin = std::max<Eigen::Index>(0, fresh - cut.burn_in);
    const Eigen::Index steps = std::min(fresh + length, episode.steps()) - begin;
    Sequence piece{episode.inputs.middleCols(begin, steps), episode.labels.segment(begin, steps),
                   episode.weights.segment(begin, steps)};
    piece.weights.head(fresh - begin).setZero();
    pieces->push_back(std::move(piece));
  }
}

std::size_t countWeighted(const std::vector<Sequence>& sequences) {
  std::size_t count = 0;
  for (const Sequence& sequence : sequences) {
    count += static_cast<std::size_t>((sequence.weights.array() > 0.0f).count());
  }
  return count;
}

int sequencesWithSteps(int steps, const std::vector<Sequence>& sequences) {
  const double steps_each = static_cast<double>(countWeighted(sequences)) / static_cast<double>(sequences.size());
  return std::max(1, static_cast<int>(std::lround(steps / steps_each)));
}

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
               "has weight " + numberText(weight) + " at step " + std::to_string(step) +
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
