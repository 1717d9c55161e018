#pragma once

namespace lstm_planner {

/// Element-wise activation functions of a dense layer or of the LSTM's candidate. In a header of its own, because the
/// kernels, which are compiled for several instruction sets, must not include Eigen.
enum class Activation { kIdentity, kTanh, kSigmoid, kRelu };

}  // namespace lstm_planner
