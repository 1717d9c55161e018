#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lstm_planner/base/network/layers.hpp"

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

/// Throws std::invalid_argument with one sentence naming `name`, the sequence and the step when a sequence is empty,
/// its parts differ in length, a value is not finite, a weight is negative, or a label is not one of `outputs` classes.
void validateSequences(const std::vector<Sequence>& sequences, int inputs, int outputs, const std::string& name);

}  // namespace lstm_planner
