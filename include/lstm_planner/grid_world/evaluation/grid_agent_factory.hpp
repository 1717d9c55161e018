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
  bool keep_closed = false;                  ///< of A*: each cell is expanded only once
  MoveCosts costs;                           ///< of A*
  bool diagonal_moves = true;                ///< of A*; false: it has four moves
  NetworkGridAgent::Options network;         ///< of a network; corner_cutting above counts
};

/// "astar", "dstar", "rolling_escape", "greedy", "boundary" and the networks: "lstm", "rnn", "mlp",
/// "qlearning", "network".
const std::vector<std::string>& gridAgentNames();

/// Whether the agent of this name needs a model. The name is only for tables: the model file says which layers it has.
bool isNetworkAgent(const std::string& name);

/// The shipped model file of the network agent with this name, relative to the package.
std::string shippedModelOf(const std::string& name);

/// A maker of such agents; a model is read here, once. Throws std::invalid_argument for an unknown name or a missing
/// model, and ModelFileError or std::invalid_argument for a model that cannot be used.
GridAgentMaker gridAgentMaker(const GridAgentOptions& options);

}  // namespace lstm_planner
