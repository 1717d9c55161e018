#include "tools/agent_list.hpp"

#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

#include "tools/shared_file.hpp"

namespace lstm_planner {
namespace {

std::string displayName(const std::string& agent) {
  static const std::map<std::string, std::string> names = {
      {"astar", "A*"}, {"dstar", "D*"}, {"lstm", "LSTM"}, {"rnn", "RNN"}, {"mlp", "MLP"}, {"qlearning", "Q-learning"}};
  const auto known = names.find(agent);
  return known == names.end() ? agent : known->second;
}

/// The options of one text, and what its name ends with.
GridAgentOptions optionsFrom(const std::string& text, GridAgentOptions options, std::string* suffix) {
  std::istringstream parts(text);
  std::string part;
  std::getline(parts, part, ',');
  const std::size_t equals = part.find('=');
  options.agent = part.substr(0, equals);
  options.model = equals == std::string::npos ? "" : part.substr(equals + 1);
  if (isNetworkAgent(options.agent)) {
    options.model = findSharedFile(options.model.empty() ? shippedModelOf(options.agent) : options.model);
  } else if (!options.model.empty()) {
    throw std::invalid_argument("agent '" + text + "' has a model, but " + options.agent + " is no network");
  }
  while (std::getline(parts, part, ',')) {
    if (part == "no-shield") {
      options.shield = false;
    } else if (part == "no-escape") {
      options.guided = false;
    } else {
      throw std::invalid_argument("agent '" + text + "' has the flag '" + part + "', expected no-shield or no-escape");
    }
    *suffix += ", " + part.replace(2, 1, " ");
  }
  return options;
}

bool isTaken(const std::vector<ReportAgent>& agents, const std::string& name) {
  for (const ReportAgent& agent : agents) {
    if (agent.agent.name == name) return true;
  }
  return false;
}

}  // namespace

std::vector<ReportAgent> agentsFromTexts(const std::vector<std::string>& texts, const GridAgentOptions& common) {
  std::vector<ReportAgent> agents;
  for (const std::string& text : texts) {
    std::string suffix;
    const GridAgentOptions options = optionsFrom(text, common, &suffix);
    const GridAgentMaker make = gridAgentMaker(options);
    std::string name = displayName(options.agent) + suffix;
    if (isTaken(agents, name) && !options.model.empty()) {
      name = displayName(options.agent) + " " + std::filesystem::path(options.model).stem().string() + suffix;
    }
    if (isTaken(agents, name)) throw std::invalid_argument("agent '" + text + "' is given twice");
    agents.push_back({{name, make}, options.agent == "astar" || options.agent == "dstar"});
  }
  return agents;
}

}  // namespace lstm_planner
