#include "tools/network_options.hpp"

namespace lstm_planner {

const Choices<Activation>& activations() {
  static const Choices<Activation> all = {
      {"tanh", Activation::kTanh}, {"sigmoid", Activation::kSigmoid}, {"relu", Activation::kRelu}};
  return all;
}

const Choices<Activation>& candidates() {
  static const Choices<Activation> all = {{"tanh", Activation::kTanh}, {"sigmoid", Activation::kSigmoid}};
  return all;
}

const Choices<Loss>& losses() {
  static const Choices<Loss> all = {{"cross-entropy", Loss::kCrossEntropy}, {"euclidean", Loss::kEuclidean}};
  return all;
}

void addActivationOptions(NetworkShape* shape, CommandLine* line) {
  line->addChoice("activation", &shape->activation, activations(),
                  "activation of the dense layers: tanh, sigmoid or relu; with reinforcement only tanh");
  line->addChoice("candidate", &shape->candidate, candidates(),
                  "activation of the LSTM layers' candidate: tanh, or sigmoid as the thesis prints (Eq. 2.21); with "
                  "reinforcement only tanh");
}

void addLossOption(Loss* loss, CommandLine* line) {
  line->addChoice(
      "loss", loss, losses(),
      "loss: cross-entropy (thesis Eq. 2.31) or euclidean (half the squared distance of the outputs to 1 for "
      "the label and 0 for the others, Eq. 2.6)");
}

}  // namespace lstm_planner
