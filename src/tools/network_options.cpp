#include "tools/network_options.hpp"

namespace lstm_planner {

namespace {

const Choices<Activation> kActivations = {
    {"tanh", Activation::kTanh}, {"sigmoid", Activation::kSigmoid}, {"relu", Activation::kRelu}};
const Choices<Activation> kCandidates = {{"tanh", Activation::kTanh}, {"sigmoid", Activation::kSigmoid}};
const Choices<Loss> kLosses = {{"cross-entropy", Loss::kCrossEntropy}, {"euclidean", Loss::kEuclidean}};

}  // namespace

void addActivationOptions(NetworkShape* shape, CommandLine* line) {
  line->addChoice("activation", &shape->activation, kActivations,
                  "activation of the dense layers: tanh, sigmoid or relu; with reinforcement only tanh");
  line->addChoice("candidate", &shape->candidate, kCandidates,
                  "activation of the LSTM layers' candidate: tanh, or sigmoid as the thesis prints (Eq. 2.21); with "
                  "reinforcement only tanh");
}

void addLossOption(Loss* loss, CommandLine* line) {
  line->addChoice(
      "loss", loss, kLosses,
      "loss: cross-entropy (thesis Eq. 2.31) or euclidean (half the squared distance of the outputs to 1 for "
      "the label and 0 for the others, Eq. 2.6)");
}

}  // namespace lstm_planner
