#include "lstm_planner/evaluation/grid_agent_factory.hpp"

#include <algorithm>
#include <stdexcept>

#include "lstm_planner/agent/a_star_agent.hpp"
#include "lstm_planner/agent/boundary_agent.hpp"
#include "lstm_planner/agent/greedy_agent.hpp"

namespace lstm_planner {
namespace {

const std::vector<std::string>& networkNames() {
  static const std::vector<std::string> names = {};
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

GridAgentMaker aStarMaker(const GridAgentOptions& options) {
  checkHeuristic(options.heuristic);
  const AStarParameters parameters{options.heuristic, options.corner_cutting};
  return [parameters](const PassableGrid& grid) { return std::make_unique<AStarAgent>(grid, parameters); };
}

GridAgentMaker boundaryMaker(const GridAgentOptions& options) {
  BoundaryParameters parameters;
  parameters.corner_cutting = options.corner_cutting;
  return [parameters](const PassableGrid& /*grid*/) { return std::make_unique<BoundaryAgent>(parameters); };
}

GridAgentMaker greedyMaker(const GridAgentOptions& options) {
  const CornerCutting corner_cutting = options.corner_cutting;
  return [corner_cutting](const PassableGrid& /*grid*/) { return std::make_unique<GreedyAgent>(corner_cutting); };
}

}  // namespace

const std::vector<std::string>& gridAgentNames() {
  static const std::vector<std::string> names = {"astar", "greedy", "boundary"};
  return names;
}

bool isNetworkAgent(const std::string& name) {
  return std::find(networkNames().begin(), networkNames().end(), name) != networkNames().end();
}

GridAgentMaker gridAgentMaker(const GridAgentOptions& options) {
  if (options.agent == "astar") return aStarMaker(options);
  if (options.agent == "greedy") return greedyMaker(options);
  if (options.agent == "boundary") return boundaryMaker(options);
  throw std::invalid_argument("there is no agent '" + options.agent + "', expected one of " + listed(gridAgentNames()));
}

}  // namespace lstm_planner
