#include "lstm_planner/robot/simulation/floor_plan.hpp"

#include "lstm_planner/base/common/parameter_check.hpp"
#include "robot/simulation/building.hpp"

namespace lstm_planner {
namespace {

constexpr double kLongestSide = 500.0;

}  // namespace

void validate(const FloorPlanParameters& parameters) {
  checkRange("resolution", parameters.resolution, 0.01, 0.2);
  checkRange("wall_thickness", parameters.wall_thickness, parameters.resolution, 1.0);
  checkRange("door_width", parameters.door_width, 0.6, 3.0);
  checkRange("smallest_room", parameters.smallest_room, parameters.door_width + 0.6, 50.0);
  const double shortest_side = parameters.smallest_room + 2.0 * (parameters.wall_thickness + parameters.resolution);
  checkRange("width", parameters.width, shortest_side, kLongestSide);
  checkRange("height", parameters.height, shortest_side, kLongestSide);
  checkRange("extra_doors", parameters.extra_doors, 0.0, 1.0);
  checkRange("furniture", parameters.furniture, 0.0, 0.5);
  checkRange("smallest_gap", parameters.smallest_gap, 0.0, 5.0);
}

OccupancyGrid generateFloorPlan(const FloorPlanParameters& parameters, std::uint64_t seed) {
  validate(parameters);
  Random random(seed);
  Building building = buildRooms(parameters, random);
  furnish(parameters, random, &building);
  return building.grid;
}

}  // namespace lstm_planner
