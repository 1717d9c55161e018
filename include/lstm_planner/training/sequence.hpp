#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// What was seen and what should have been done, step by step: an episode, or a piece of one.
///
/// The hidden state is zero at the first step, as after Network::reset(), and errors are propagated back to it: an
/// episode that is to be learned with truncated back-propagation is cut into several sequences by the caller.
struct Sequence {
  Eigen::MatrixXf inputs;   ///< features x steps, as the network gets them (encoded)
  Eigen::VectorXi labels;   ///< one class a step, in [0, outputs of the network)
  Eigen::VectorXf weights;  ///< one a step, >= 0; a step with 0 moves the hidden state only, its label is not looked at

  Eigen::Index steps() const { return inputs.cols(); }
};

/// How an episode is cut into pieces, along which errors go back.
struct SequenceCut {
  Eigen::Index first = 0;    ///< steps of the first piece, > 0
  Eigen::Index further = 0;  ///< new steps of each further one, > 0
  Eigen::Index burn_in = 0;  ///< before these, so many steps of the piece before, where there are: they have no weight,
                             ///< and bring the hidden state up to date
};

/// Pieces of at most `steps`, the first `burn_in` of all but the first repeated.
inline SequenceCut overlappingPieces(Eigen::Index steps, Eigen::Index burn_in) {
  return {steps, steps - burn_in, burn_in};
}

/// Appends the pieces of an episode.
void cutIntoPieces(const Sequence& episode, const SequenceCut& cut, std::vector<Sequence>* pieces);

/// Steps with a weight above 0.
std::size_t countWeighted(const std::vector<Sequence>& sequences);

/// How many of the sequences, of which there must be one, have about so many steps with a weight: at least 1.
int sequencesWithSteps(int steps, const std::vector<Sequence>& sequences);

/// Throws std::invalid_argument with one sentence naming `name`, the sequence and the step when a sequence is empty,
/// its parts differ in length, a value is not finite, a weight is negative, or a label is not one of `outputs` classes.
void validateSequences(const std::vector<Sequence>& sequences, int inputs, int outputs, const std::string& name);

}  // namespace lstm_planner
