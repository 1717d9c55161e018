#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_imitation.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/training/initialisation.hpp"

namespace lstm_planner {

/// The thesis's training by its own rules: Tables 3.1 and 3.2 as in thesisImitation(), corners may be cut, and the
/// supervisor is A* with its heuristic.
GridImitationParameters thesisTraining();

/// A network of the thesis's online tests.
struct ThesisNetwork {
  std::string name;  ///< in tables
  std::string file;  ///< without folder
  NetworkShape shape;
  double learning_rate = 0.1;  ///< Table 3.2; that of the perceptron is not printed
};

/// Two LSTM layers of 8 cells (Fig. 3.8a), two of 16, and the perceptron of four layers of 64 units (Fig. 3.8b).
const std::vector<ThesisNetwork>& thesisNetworks();

/// Result of the training of one network.
struct ThesisNetworkResult {
  Model model;  ///< with the metadata that a file needs
  double training_accuracy = 0.0;
  double validation_accuracy = 0.0;  ///< of the best epoch
};

/// Trains one network on the maps of the scenario files; each map counts the same. Calls `progress` with the share that
/// is done; if it returns false, the training ends. Throws as gridImitation() and readMovingAiMap().
ThesisNetworkResult trainThesisNetwork(const ThesisNetwork& network, const GridImitationParameters& parameters,
                                       const std::vector<std::string>& training_files,
                                       const std::vector<std::string>& validation_files,
                                       const std::function<bool(double)>& progress = {});

}  // namespace lstm_planner
