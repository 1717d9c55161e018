#include "lstm_planner/training/memory_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/common/markdown_table.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/training/trainer.hpp"
#include "training/input_sensitivity.hpp"

namespace lstm_planner {
namespace {

constexpr int kSymbolInputs = 3;
constexpr int kSymbols = 2;

/// Sequences to judge by are drawn with this distance from those to learn from.
constexpr std::uint64_t kTestSeed = 1000;

LayerStack startOf(const MemoryNetwork& network, std::uint64_t seed) {
  return initialised(makeNetwork(kSymbolInputs, network.shape, kSymbols), seed, network.start);
}

LayerStack trained(const MemoryComparisonParameters& parameters, const MemoryNetwork& network, int delay,
                   std::uint64_t seed) {
  TrainerParameters trainer;
  trainer.epochs = parameters.epochs;
  trainer.batch_size = 64;
  trainer.threads = parameters.threads;
  trainer.seed = seed;
  trainer.optimiser.learning_rate = parameters.learning_rate;
  return train(startOf(network, seed), recallSequences(parameters.sequences, delay, seed), {}, trainer).layers;
}

double radiusOf(const LayerStack& layers) {
  const auto* plain = std::get_if<RecurrentLayer>(&layers.front());
  return plain != nullptr ? spectralRadius(*plain) : 0.0;
}

void measure(const MemoryComparisonParameters& parameters, const LayerStack& before, const LayerStack& after,
             MemoryOutcome* outcome) {
  const auto sequences =
      recallSequences(parameters.measured_sequences, parameters.shown_delay, parameters.seed + kTestSeed);
  outcome->before = firstStepSensitivity(before, sequences);
  outcome->after = firstStepSensitivity(after, sequences);
  outcome->radius_before = radiusOf(before);
  outcome->radius_after = radiusOf(after);
}

/// Geometric mean of the factor by which the sensitivity changes from step to step.
double factorAStep(const Eigen::VectorXd& relative) {
  return std::pow(relative[relative.size() - 1], 1.0 / static_cast<double>(relative.size() - 1));
}

/// "1.5e-03 (0.90)", or "-" where saturated units do not depend on the first step at all.
std::string lastAndFactor(const Eigen::VectorXd& relative) {
  if (!relative.allFinite()) return "-";
  std::ostringstream text;
  text << std::scientific << std::setprecision(1) << relative[relative.size() - 1] << " ("
       << fixedText(factorAStep(relative), 2) << ')';
  return text.str();
}

std::string percentRange(std::vector<double> shares) {
  std::sort(shares.begin(), shares.end());
  double sum = 0.0;
  for (const double share : shares) sum += share;
  const std::string mean = fixedText(100.0 * sum / static_cast<double>(shares.size()), 1);
  if (shares.size() == 1) return mean;
  return mean + " (" + fixedText(100.0 * shares.front(), 1) + "-" + fixedText(100.0 * shares.back(), 1) + ')';
}

}  // namespace

std::vector<Sequence> recallSequences(int count, int delay, std::uint64_t seed) {
  Random random(seed);
  std::vector<Sequence> sequences;
  for (int index = 0; index < count; ++index) {
    Sequence sequence{Eigen::MatrixXf::Zero(3, delay + 1), Eigen::VectorXi::Zero(delay + 1),
                      Eigen::VectorXf::Zero(delay + 1)};
    for (int step = 0; step <= delay; ++step) {
      sequence.inputs(static_cast<Eigen::Index>(uniformIndex(random, 2)), step) = 1.0f;
    }
    sequence.inputs(2, 0) = 1.0f;
    sequence.labels[delay] = sequence.inputs(0, 0) > 0.5f ? 0 : 1;
    sequence.weights[delay] = 1.0f;
    sequences.push_back(sequence);
  }
  return sequences;
}

std::vector<MemoryNetwork> memoryNetworks() {
  NetworkShape lstm;
  lstm.cells = {8};
  NetworkShape equal_units;
  equal_units.kind = NetworkShape::Kind::kRnn;
  equal_units.cells = {8};
  NetworkShape equal_weights = equal_units;
  equal_weights.cells = {17};
  InitialisationParameters small;
  small.range = 0.1;
  const auto withForgetGate = [](double bias) {
    InitialisationParameters start;
    start.forget_gate_bias = bias;
    return start;
  };
  return {{"RNN 8", equal_units, {}},
          {"RNN 17", equal_weights, {}},
          {"RNN 17, weights within 0.1", equal_weights, small, "figure_2_06"},
          {"LSTM 8, forget gate bias 0", lstm, withForgetGate(0.0)},
          {"LSTM 8, bias 1", lstm, withForgetGate(1.0)},
          {"LSTM 8, bias 4", lstm, withForgetGate(4.0), "figure_2_09"}};
}

void validate(const MemoryComparisonParameters& parameters) {
  if (parameters.delays.empty()) throw std::invalid_argument("delays is empty, expected at least one");
  for (const int delay : parameters.delays) checkAtLeastOne("delays", delay);
  checkParameter(std::count(parameters.delays.begin(), parameters.delays.end(), parameters.shown_delay) > 0,
                 "shown_delay", parameters.shown_delay, "one of the delays");
  checkAtLeastOne("sequences", parameters.sequences);
  checkAtLeastOne("measured_sequences", parameters.measured_sequences);
  checkAtLeastOne("epochs", parameters.epochs);
  checkAtLeastOne("seeds", parameters.seeds);
  checkAtLeastOne("threads", parameters.threads);
  checkPositive("learning_rate", parameters.learning_rate);
}

std::vector<MemoryOutcome> compareMemory(const MemoryComparisonParameters& parameters,
                                         const std::vector<MemoryNetwork>& networks,
                                         const std::function<bool(double)>& progress) {
  validate(parameters);
  double steps_done = 0.0;
  double steps = 0.0;
  for (const int delay : parameters.delays) steps += delay + 1.0;
  steps *= static_cast<double>(networks.size()) * parameters.seeds;
  std::vector<MemoryOutcome> outcomes;
  for (const MemoryNetwork& network : networks) {
    MemoryOutcome outcome;
    outcome.network = network;
    outcome.weights = countWeights(startOf(network, parameters.seed));
    for (const int delay : parameters.delays) {
      outcome.accuracies.emplace_back();
      for (int run = 0; run < parameters.seeds; ++run) {
        const std::uint64_t seed = parameters.seed + static_cast<std::uint64_t>(run);
        const LayerStack layers = trained(parameters, network, delay, seed);
        const auto test = recallSequences(parameters.sequences, delay, seed + kTestSeed);
        outcome.accuracies.back().push_back(evaluate(layers, test, parameters.threads).accuracy());
        if (run == 0 && delay == parameters.shown_delay) {
          measure(parameters, startOf(network, seed), layers, &outcome);
        }
        steps_done += delay + 1.0;
        if (progress && !progress(steps_done / steps)) return outcomes;
      }
    }
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

Eigen::VectorXd relativeSensitivity(const Eigen::MatrixXd& sensitivity) {
  const Eigen::VectorXd lengths = sensitivity.colwise().norm().transpose();
  return lengths / lengths[0];
}

std::string memoryTables(const MemoryComparisonParameters& parameters, const std::vector<MemoryOutcome>& outcomes) {
  std::ostringstream text;
  text << "Accuracy in %, of one symbol of two remembered for so many steps:\n\n";
  std::vector<std::string> headings = {"network", "weights"};
  for (const int delay : parameters.delays) headings.push_back(std::to_string(delay) + " steps");
  MarkdownTable accuracy_table(headings, &text);
  for (const MemoryOutcome& outcome : outcomes) {
    std::vector<std::string> cells = {outcome.network.name, std::to_string(outcome.weights)};
    for (const auto& accuracies : outcome.accuracies) cells.push_back(percentRange(accuracies));
    accuracy_table.row(cells);
  }
  text << "\nSensitivity of the units to the first step's input, " << parameters.shown_delay
       << " steps later, relative to the first step; in brackets the factor a step:\n\n";
  MarkdownTable table({"network", "before the training", "after it", "spectral radius before", "after"}, &text);
  for (const MemoryOutcome& outcome : outcomes) {
    const Eigen::VectorXd before = relativeSensitivity(outcome.before);
    const Eigen::VectorXd after = relativeSensitivity(outcome.after);
    const auto radiusText = [](double radius, bool known) { return known ? fixedText(radius, 2) : "-"; };
    const bool known = outcome.radius_before > 0.0;
    table.row({outcome.network.name, lastAndFactor(before), lastAndFactor(after),
               radiusText(outcome.radius_before, known), radiusText(outcome.radius_after, known)});
  }
  return text.str();
}

}  // namespace lstm_planner
