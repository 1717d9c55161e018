#pragma once

#include <string>
#include <vector>

#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/search/heuristic.hpp"

namespace lstm_planner {

/// Which agent, and how it is set up.
struct GridAgentOptions {
  std::string agent = "lstm";
  std::string model;  ///< ONNX file of an agent that is a network
  CornerCutting corner_cutting = CornerCutting::kForbidden;
  Heuristic heuristic = Heuristic::kOctile;  ///< of A*
  bool keep_closed = false;                  ///< of A*: cells are expanded once, however reached later
  MoveCosts costs;                           ///< of A*
  bool diagonal_moves = true;                ///< of A*; false: it has four moves
  NetworkGridAgent::Options network;         ///< of a network, but for the corners
};

/// "astar", "dstar", "rolling_escape", "greedy", "boundary" and the networks: "lstm", "rnn", "mlp",
/// "qlearning", "network".
const std::vector<std::string>& gridAgentNames();

/// Whether the agent of this name needs a model. Which layers it has is the model file's business; the names say what
/// a table calls it.
bool isNetworkAgent(const std::string& name);

/// The shipped file, relative to the package, of a network agent's name.
std::string shippedModelOf(const std::string& name);

/// A maker of such agents; a model is read once, here. Throws std::invalid_argument for an unknown name, a missing
/// model, and ModelFileError or std::invalid_argument for a model that cannot be used.
GridAgentMaker gridAgentMaker(const GridAgentOptions& options);

}  // namespace lstm_planner
