#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "lstm_planner/grid/passable_grid.hpp"
#include "lstm_planner/grid_world/world/scenario_generator.hpp"

namespace lstm_planner {

/// Generated maps that are stored like a set of the grid benchmark: FOLDER/Maps/NAME-k.map and
/// FOLDER/Scenarios/NAME-k.map.scen for k = 0 .. count - 1.
struct MapSet {
  std::string name;
  int count = 1;
  std::function<PassableGrid(std::uint64_t seed)> generate;  ///< a generator of map_generators.hpp
  ScenarioDrawParameters scenarios;
  std::uint64_t seed = 1;  ///< of the first map and its scenarios; map k has seed + k
};
/// Throws std::invalid_argument for a count below 1, a name that cannot be that of a file, or bad parameters of the
/// scenarios.
void validate(const MapSet& set);

/// Writes the set into the two folders, which must exist; files of the same names are replaced. Calls `progress` with
/// the share that is done. Returns the number of scenarios. Throws as validate(), MovingAiFileError when a
/// file cannot be written, std::runtime_error for a map without two connected cells, and what the generator throws.
std::size_t writeMapSet(const std::string& folder, const MapSet& set, const std::function<void(double)>& progress = {});

}  // namespace lstm_planner
