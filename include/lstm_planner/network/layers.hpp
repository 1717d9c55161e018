#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <variant>
#include <vector>

#include "lstm_planner/network/activation.hpp"

namespace lstm_planner {

/// One LSTM layer with `cells` memory cells on `inputs` values (thesis Eq. 2.21-2.25).
///
/// The four gates are stacked in the rows of each matrix in the order of the ONNX operator:
///
///            inputs          cells        1
///        +-----------+   +-----------+   +-+
///   i    |           |   |           |   | |   input gate     (g in Eq. 2.23)
///   o    |  input    |   | recurrent |   |b|   output gate    (q in Eq. 2.25)
///   f    |           |   |           |   | |   forget gate    (f in Eq. 2.22)
///   c    |           |   |           |   | |   candidate      (inside Eq. 2.21)
///        +-----------+   +-----------+   +-+   each block `cells` rows
///
/// The cell state is s' = f * s + i * candidate, the output is h = tanh(s') * o. The thesis prints a sigmoid as the
/// activation of the candidate; Caffe, ONNX and PyTorch have tanh. Both are possible here.
struct LstmLayer {
  Eigen::MatrixXf input;                     ///< 4 cells x inputs
  Eigen::MatrixXf recurrent;                 ///< 4 cells x cells
  Eigen::VectorXf bias;                      ///< 4 cells
  Activation candidate = Activation::kTanh;  ///< kTanh or kSigmoid
};

/// A plain recurrent layer, h' = tanh(input x + recurrent h + bias) (thesis Eq. 2.14-2.15).
struct RecurrentLayer {
  Eigen::MatrixXf input;      ///< units x inputs
  Eigen::MatrixXf recurrent;  ///< units x units
  Eigen::VectorXf bias;
};

/// A fully connected layer, y = activation(weights x + bias) (thesis Eq. 2.1-2.4).
struct DenseLayer {
  Eigen::MatrixXf weights;  ///< outputs x inputs
  Eigen::VectorXf bias;
  Activation activation = Activation::kIdentity;
};

/// Turns preferences into probabilities (thesis Eq. 2.28).
struct SoftmaxLayer {};

using Layer = std::variant<LstmLayer, RecurrentLayer, DenseLayer, SoftmaxLayer>;

/// Layers in the order in which they are evaluated.
using LayerStack = std::vector<Layer>;

/// Number of learnable weights as the thesis counts them (Eq. 3.17-3.22): a bias is the weight of the constant input 1,
/// and a gate of an LSTM has one bias for each cell. 11 -> LSTM 8 -> LSTM 8 -> FC 8 has 640 + 544 + 72 = 1,256.
std::size_t countWeights(const LayerStack& layers);

/// Number of inputs and of outputs. Throws std::invalid_argument if no layer determines it (an empty stack, or only a
/// softmax).
int inputSize(const LayerStack& layers);
int outputSize(const LayerStack& layers);

/// Throws std::invalid_argument naming the layer if shapes do not fit together, a weight is not finite, or an
/// activation is not possible there. A softmax must follow another layer, which determines its width.
void validateLayers(const LayerStack& layers);

}  // namespace lstm_planner
