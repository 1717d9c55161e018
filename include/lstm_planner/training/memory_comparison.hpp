#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// The task that shows how long a network remembers (thesis 2.2): one of two symbols at the first step, then random
/// ones for `delay` steps; only the last step counts, and its label is the first symbol. The three inputs are the two
/// symbols and a mark at the first step. `delay` is not negative; the same seed gives the same sequences.
std::vector<Sequence> recallSequences(int count, int delay, std::uint64_t seed);

/// A network of the comparison.
struct MemoryNetwork {
  std::string name;
  NetworkShape shape;
  InitialisationParameters start;
  std::string figure = "";  ///< file name of its figure, see writeMemoryFigures(); empty: none is drawn
};

/// Plain recurrent networks with as many units as an LSTM and with about as many weights, the latter also with weights
/// so small that W^t vanishes; and the LSTM with its forget gate half open, with the bias with which trainings here
/// start, and open.
std::vector<MemoryNetwork> memoryNetworks();

/// What the networks are asked to remember, and how they are trained.
struct MemoryComparisonParameters {
  std::vector<int> delays = {5, 10, 20, 40, 80};  ///< steps that the networks have to remember, each >= 1
  int shown_delay = 20;                           ///< delay at which the sensitivity is measured; one of `delays`
  int sequences = 1000;                           ///< to learn from; so many others are used to judge
  int measured_sequences = 16;                    ///< over which the sensitivity is averaged
  int epochs = 30;
  double learning_rate = 0.02;
  int seeds = 5;  ///< trainings of each network, with the seeds from `seed` on
  std::uint64_t seed = 1;
  int threads = 2;  ///< does not change the result
};
/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const MemoryComparisonParameters& parameters);

/// Result of one network.
struct MemoryOutcome {
  MemoryNetwork network;
  std::size_t weights = 0;
  std::vector<std::vector<double>> accuracies;  ///< by delay, then by seed; 0.5 is chance
  /// How much the units of the first layer (rows) depend at each step (columns) on the inputs of the first step: length
  /// of the derivative, root of the mean square over sequences. Of the network of the first seed with initial weights,
  /// and after training on `shown_delay`.
  Eigen::MatrixXd before;
  Eigen::MatrixXd after;
  /// Largest absolute eigenvalue of the recurrent weights of the same; 0 for an LSTM.
  double radius_before = 0.0;
  double radius_after = 0.0;
};

/// Trains networks on recallSequences() of each delay (thesis 2.2: what Figures 2.6 and 2.9 show). The same for any
/// number of threads. Calls `progress` with the share that is done; if it returns false, the comparison ends early with
/// what is complete. Throws as validate().
std::vector<MemoryOutcome> compareMemory(const MemoryComparisonParameters& parameters,
                                         const std::vector<MemoryNetwork>& networks,
                                         const std::function<bool(double)>& progress = {});

/// For each step: the sensitivity over all units, relative to the first step.
Eigen::VectorXd relativeSensitivity(const Eigen::MatrixXd& sensitivity);

/// A Markdown table of the accuracies and one of how fast the sensitivity falls.
std::string memoryTables(const MemoryComparisonParameters& parameters, const std::vector<MemoryOutcome>& outcomes);

/// Draws with gnuplot as PNG files, with a CSV file beside each: `folder`/sensitivity (relativeSensitivity() of each
/// network before and after its training), and for networks that have a figure the sensitivity of each unit as shades.
/// Throws std::runtime_error if a file cannot be written, or if gnuplot is missing or fails.
void writeMemoryFigures(const std::string& folder, const std::vector<MemoryOutcome>& outcomes);

}  // namespace lstm_planner
