#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// How random weights are drawn before training; biases start at 0.
struct InitialisationParameters {
  /// Weights are uniform in +-range. If it is not set, they are uniform in +-sqrt(6 / (fan in + fan out)), for each
  /// gate separately (Xavier: Glorot and Bengio, AISTATS 2010).
  std::optional<double> range;
  double forget_gate_bias = 1.0;  ///< cells with an open forget gate remember longer (Jozefowicz et al., ICML 2015)
};

/// These layers with random weights; the same seed gives the same weights on every machine.
/// Throws std::invalid_argument for a range that is not positive and finite or a bias that is not finite.
LayerStack initialised(LayerStack layers, std::uint64_t seed, const InitialisationParameters& parameters = {});

/// Stacked LSTM layers with `cells[i]` cells each and one linear layer with `outputs` outputs, all zero. Throws as
/// makeNetwork().
LayerStack makeLstmStack(int inputs, const std::vector<int>& cells, int outputs,
                         Activation candidate = Activation::kTanh);

/// Stacked fully connected layers with `units[i]` units each (tanh) and one linear layer with `outputs` outputs, all
/// zero: a network without memory. Throws std::invalid_argument if a size is not positive.
LayerStack makeDenseStack(int inputs, const std::vector<int>& units, int outputs);

/// The shape of a network that decides step by step (thesis Fig. 2.10): dense layers before the recurrent ones
/// ("deep-in"), recurrent layers one on the other ("stacked"), dense layers behind them ("deep-out"), and one linear
/// layer with the preferences.
struct NetworkShape {
  /// What the layers in the middle are.
  enum class Kind {
    kLstm,  ///< LSTM layers
    kRnn,   ///< plain recurrent layers
    kMlp,   ///< no memory: a multilayer perceptron
  };
  Kind kind = Kind::kLstm;
  std::vector<int> cells = {8, 8};            ///< of each recurrent layer; of a perceptron the units of each layer
  std::vector<int> deep_in;                   ///< units of each layer before; none for a perceptron
  std::vector<int> deep_out;                  ///< units of each layer behind; none for a perceptron
  Activation activation = Activation::kTanh;  ///< of all dense layers but the last (thesis Fig. 2.2); not kIdentity
  Activation candidate = Activation::kTanh;   ///< of LSTM layers; thesis Eq. 2.21 prints kSigmoid
};

/// Such a network, all zero. Throws std::invalid_argument if a size is not positive, if there are no cells, if a
/// perceptron has deep-in or deep-out layers, or if an activation other than tanh is set for layers that the network
/// does not have.
LayerStack makeNetwork(int inputs, const NetworkShape& shape, int outputs);

}  // namespace lstm_planner
