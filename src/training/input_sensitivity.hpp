#pragma once

#include <Eigen/Core>
#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// How much the units of the stack's first layer, which must be recurrent, depend on what they saw at the first step
/// (thesis Figures 2.6 and 2.9): a row a unit, a column a step, the length of the derivative of the unit's output at
/// the step by the inputs of the first step; root of the mean square over the sequences. Computed in double precision.
///
/// Throws std::invalid_argument for a stack whose first layer is not recurrent, no sequences, or sequences that differ
/// in length.
Eigen::MatrixXd firstStepSensitivity(const LayerStack& layers, const std::vector<Sequence>& sequences);

/// Largest absolute value of the eigenvalues of a recurrent layer's matrix W: where it is below 1, W^t vanishes with t
/// (thesis Eq. 2.20).
double spectralRadius(const RecurrentLayer& layer);

}  // namespace lstm_planner
