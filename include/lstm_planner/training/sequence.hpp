#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// What was seen and what should have been done, step by step: an episode, or a piece of one.
///
/// The hidden state is zero at the first step, as after Network::reset(), and errors are propagated back to this step.
/// For truncated back-propagation the caller cuts an episode into several sequences.
struct Sequence {
  Eigen::MatrixXf inputs;   ///< features x steps, as the network gets them (encoded)
  Eigen::VectorXi labels;   ///< one class for each step, in [0, outputs of the network)
  Eigen::VectorXf weights;  ///< one for each step, >= 0; with 0 it only moves the hidden state, the label is not used

  Eigen::Index steps() const { return inputs.cols(); }
};

/// How an episode is cut into pieces, along which errors go back.
struct SequenceCut {
  Eigen::Index first = 0;    ///< steps of the first piece, > 0
  Eigen::Index further = 0;  ///< new steps of each later piece, > 0
  Eigen::Index burn_in = 0;  ///< steps of the piece before that are repeated before these, if there are so many: they
                             ///< have no weight, and only set the hidden state
};

/// Pieces of at most `steps` steps; in all but the first piece, `burn_in` of them are repeated.
inline SequenceCut overlappingPieces(Eigen::Index steps, Eigen::Index burn_in) {
  return {steps, steps - burn_in, burn_in};
}

/// Appends the pieces of an episode.
void cutIntoPieces(const Sequence& episode, const SequenceCut& cut, std::vector<Sequence>* pieces);

/// Number of steps with a weight above 0.
std::size_t countWeighted(const std::vector<Sequence>& sequences);

/// How many of the sequences have about so many steps with a weight, on average; at least 1. There must be a sequence.
int sequencesWithSteps(int steps, const std::vector<Sequence>& sequences);

/// Throws std::invalid_argument with one sentence naming `name`, the sequence and the step if a sequence is empty, if
/// its parts differ in length, if there are not `inputs` features, if a value is not finite, if a weight is negative,
/// or if a label of a step with a weight is not one of `outputs` classes.
void validateSequences(const std::vector<Sequence>& sequences, int inputs, int outputs, const std::string& name);

}  // namespace lstm_planner
