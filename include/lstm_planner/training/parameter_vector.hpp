#pragma once

#include <Eigen/Core>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// All weights and biases of a stack in one vector, the w of thesis Eq. 3.7-3.14: layer after layer, in each layer the
/// input weights, the recurrent weights, the bias, matrices column by column.
Eigen::VectorXf parameterVector(const LayerStack& layers);

/// Writes such a vector into the layers. Throws std::invalid_argument if its size is not their number of parameters.
void setParameterVector(const Eigen::VectorXf& parameters, LayerStack& layers);

/// 1 where parameterVector() holds a weight, 0 where it holds a bias.
Eigen::VectorXf weightMask(const LayerStack& layers);

}  // namespace lstm_planner
