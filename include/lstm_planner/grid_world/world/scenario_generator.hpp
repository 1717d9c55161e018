#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner {

/// Bucket b of a scenario file holds the shortest paths of 4 b up to 4 (b + 1) cells.
constexpr double kBucketLength = 4.0;

/// How many scenarios are drawn.
struct ScenarioDrawParameters {
  int per_bucket = 10;  ///< scenarios in every bucket, if the map has so many
};
/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const ScenarioDrawParameters& parameters);

/// Draws scenarios for a map like those of the grid benchmark: equally many in every bucket, in the order of buckets,
/// each with the length of the shortest path without corner cutting. Goals are random passable cells; each goal gets at
/// most one start in a bucket, a random one among the cells at that distance. At most 3 * per_bucket goals are drawn,
/// so the last buckets, for which few pairs of cells are far enough apart, may hold fewer. Start and goal differ. The
/// result is empty if no two cells are connected. The same map, parameters and seed give the same scenarios on every
/// machine. `map_name` is written into every scenario; `progress` is called with the share that is done. Throws as
/// validate().
std::vector<Scenario> drawScenarios(const PassableGrid& grid, const std::string& map_name,
                                    const ScenarioDrawParameters& parameters, std::uint64_t seed,
                                    const std::function<void(double)>& progress = {});

}  // namespace lstm_planner
