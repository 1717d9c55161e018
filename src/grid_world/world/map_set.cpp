#include "lstm_planner/grid_world/world/map_set.hpp"

#include <algorithm>
#include <stdexcept>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner {
namespace {

void checkName(const std::string& name) {
  const bool fine = !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char letter) {
    return static_cast<unsigned char>(letter) > 0x20 && letter != '/';
  });
  if (!fine) throw std::invalid_argument("the maps' name is '" + name + "', expected a file's name without blanks");
}

}  // namespace

void validate(const MapSet& set) {
  checkName(set.name);
  checkAtLeastOne("count", set.count);
  validate(set.scenarios);
}

std::size_t writeMapSet(const std::string& folder, const MapSet& set, const std::function<void(double)>& progress) {
  validate(set);
  std::size_t scenario_count = 0;
  for (int k = 0; k < set.count; ++k) {
    const std::string file = set.name + "-" + std::to_string(k) + ".map";
    const std::uint64_t seed = set.seed + static_cast<std::uint64_t>(k);
    const PassableGrid grid = set.generate(seed);
    const auto tell = [&](double share) {
      if (progress) progress((k + share) / set.count);
    };
    const std::vector<Scenario> scenarios = drawScenarios(grid, file, set.scenarios, seed, tell);
    if (scenarios.empty()) throw std::runtime_error("the map " + file + " has no two connected cells");
    writeMovingAiMap(folder + "/Maps/" + file, grid);
    writeScenarios(folder + "/Scenarios/" + file + ".scen", scenarios);
    scenario_count += scenarios.size();
    tell(1.0);
  }
  return scenario_count;
}

}  // namespace lstm_planner
