#include "tools/training.hpp"

#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/command_line.hpp"

namespace lstm_planner {
namespace {

const Choices<NetworkShape::Kind> kKinds = {
    {"lstm", NetworkShape::Kind::kLstm}, {"rnn", NetworkShape::Kind::kRnn}, {"mlp", NetworkShape::Kind::kMlp}};
const Choices<Activation> kActivations = {
    {"tanh", Activation::kTanh}, {"sigmoid", Activation::kSigmoid}, {"relu", Activation::kRelu}};
const Choices<Activation> kCandidates = {{"tanh", Activation::kTanh}, {"sigmoid", Activation::kSigmoid}};
const Choices<Loss> kLosses = {{"cross-entropy", Loss::kCrossEntropy}, {"euclidean", Loss::kEuclidean}};

}  // namespace

void ToolTrainingHost::started(bool resumed) {
  if (resumed) std::cout << "going on from " << options_.checkpoint << " after " << position() << std::endl;
  printHeader();
}

int ToolTrainingHost::end(const TrainingOutcome& outcome) const {
  if (outcome.best) {
    std::cout << "wrote " << options_.output << ": " << scoreText(*outcome.best) << std::endl;
  }
  if (!outcome.stopped) return 0;
  std::cout << "interrupted; "
            << (options_.checkpoint.empty() ? "without --checkpoint the training cannot be continued" : resumption())
            << std::endl;
  return interruption_.exitStatus();
}

std::string positionOf(const ImitationRounds& rounds) {
  return std::to_string(rounds.round() - 1) + " rounds and " + std::to_string(rounds.epochsOfRound()) + " epochs";
}

void addShapeOptions(NetworkShape* shape, const std::vector<int>& mlp_units, CommandLine* line) {
  std::string units;
  for (const int count : mlp_units) units += " " + std::to_string(count);
  line->addChoice("network", &shape->kind, kKinds, "lstm, rnn or mlp");
  line->add("cells", &shape->cells, kAnyLayer,
            "cells of each recurrent layer, or units of each layer of an mlp (default of an mlp:" + units + ")");
  line->add("deep-in", &shape->deep_in, kAnyLayer, "units of each dense layer before the recurrent ones");
  line->add("deep-out", &shape->deep_out, kAnyLayer, "units of each dense layer after the recurrent ones");
  line->addChoice("activation", &shape->activation, kActivations,
                  "activation of the dense layers: tanh, sigmoid or relu; with reinforcement only tanh");
  line->addChoice("candidate", &shape->candidate, kCandidates,
                  "activation of the LSTM layers' candidate: tanh, or sigmoid as the thesis prints (Eq. 2.21); with "
                  "reinforcement only tanh");
  line->whenParsed([=] {
    if (shape->kind == NetworkShape::Kind::kMlp && !line->given("cells")) shape->cells = mlp_units;
  });
}

void checkModelDecides(const CommandLine& line, const std::string& from, std::vector<std::string> decided) {
  decided.insert(decided.end(), {"network", "cells", "deep-in", "deep-out", "activation", "candidate"});
  for (const std::string& option : decided) {
    if (!line.given(option)) continue;
    throw std::invalid_argument("--" + option + " is determined by the model of " + from);
  }
}

void addLossOption(Loss* loss, CommandLine* line) {
  line->addChoice(
      "loss", loss, kLosses,
      "loss: cross-entropy (thesis Eq. 2.31) or euclidean (half the squared distance of the outputs to 1 for "
      "the label and 0 for the others, Eq. 2.6)");
}

}  // namespace lstm_planner
