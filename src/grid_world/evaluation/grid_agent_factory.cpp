#include "lstm_planner/grid_world/evaluation/grid_agent_factory.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "grid_world/agent/a_star_agent.hpp"
#include "grid_world/agent/d_star_agent.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/grid_world/agent/boundary_follower.hpp"
#include "lstm_planner/grid_world/agent/greedy_agent.hpp"
#include "lstm_planner/grid_world/agent/grid_guide.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/network/model_file.hpp"

namespace lstm_planner {
namespace {

const char* const kNetworkNames[] = {"lstm", "rnn", "mlp", "qlearning", "network"};

GridAgentMaker aStarMaker(const GridAgentOptions& options) {
  AStarParameters parameters{options.heuristic, options.corner_cutting};
  if (options.keep_closed) parameters.closed_cells = ClosedCells::kStayClosed;
  parameters.costs = options.costs;
  parameters.diagonal_moves = options.diagonal_moves;
  return [parameters](const PassableGrid& grid) { return std::make_unique<AStarAgent>(grid, parameters); };
}

GridAgentMaker networkMaker(const GridAgentOptions& options) {
  if (options.model.empty()) {
    throw std::invalid_argument("agent " + options.agent + " has no model, expected an ONNX file");
  }
  NetworkGridAgent::Options settings = options.network;
  settings.corner_cutting = options.corner_cutting;
  const auto model = std::make_shared<const Model>(readModelFile(options.model));
  try {
    NetworkGridAgent(*model, settings);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("model '" + options.model + "' is not for the grid world: " + error.what());
  }
  return
      [model, settings](const PassableGrid& /*grid*/) { return std::make_unique<NetworkGridAgent>(*model, settings); };
}

}  // namespace

const std::vector<std::string>& gridAgentNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {"astar", "dstar", "rolling_escape", "greedy", "boundary"};
    all.insert(all.end(), std::begin(kNetworkNames), std::end(kNetworkNames));
    return all;
  }();
  return names;
}

bool isNetworkAgent(const std::string& name) {
  return std::find(std::begin(kNetworkNames), std::end(kNetworkNames), name) != std::end(kNetworkNames);
}

std::string shippedModelOf(const std::string& name) {
  if (name == "rnn") return "models/grid_rnn_2x16.onnx";
  if (name == "mlp") return "models/grid_mlp_4x64.onnx";
  if (name == "qlearning") return "models/grid_qlearning.onnx";
  return "models/grid_lstm_2x8.onnx";
}

GridAgentMaker gridAgentMaker(const GridAgentOptions& options) {
  const CornerCutting corners = options.corner_cutting;
  if (options.agent == "astar") return aStarMaker(options);
  if (options.agent == "dstar") {
    return [corners](const PassableGrid& grid) {
      return std::make_unique<DStarAgent>(grid.columns(), grid.rows(), corners);
    };
  }
  if (options.agent == "rolling_escape") {
    GridGuideParameters parameters;
    parameters.corner_cutting = corners;
    return [parameters](const PassableGrid& /*grid*/) { return std::make_unique<GridGuide>(parameters); };
  }
  if (options.agent == "greedy") {
    return [corners](const PassableGrid& /*grid*/) { return std::make_unique<GreedyAgent>(corners); };
  }
  if (options.agent == "boundary") {
    return [corners](const PassableGrid& /*grid*/) {
      return std::make_unique<BoundaryFollower>(BoundaryParameters{corners});
    };
  }
  if (isNetworkAgent(options.agent)) return networkMaker(options);
  throw std::invalid_argument("there is no agent '" + options.agent + "', expected one of " + joined(gridAgentNames()));
}

}  // namespace lstm_planner
