#include "lstm_planner/simulation/floor_plan.hpp"

#include <sstream>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "simulation/building.hpp"

namespace lstm_planner {

void validate(const FloorPlanParameters& parameters) {
  visitFloorPlanParameters(parameters, RangeCheck());
  const auto atLeast = [](const char* name, double value, double least) {
    std::ostringstream expected;
    expected << "at least " << least;
    checkParameter(isAtMost(least, value), name, value, expected.str());
  };
  atLeast("wall_thickness", parameters.wall_thickness, parameters.resolution);
  atLeast("smallest_room", parameters.smallest_room, parameters.door_width + 0.6);
  const double shortest_side = parameters.smallest_room + 2.0 * (parameters.wall_thickness + parameters.resolution);
  atLeast("width", parameters.width, shortest_side);
  atLeast("height", parameters.height, shortest_side);
}

OccupancyGrid generateFloorPlan(const FloorPlanParameters& parameters, std::uint64_t seed) {
  validate(parameters);
  Random random(seed);
  Building building = buildRooms(parameters, random);
  furnish(parameters, random, &building);
  return building.grid;
}

}  // namespace lstm_planner
