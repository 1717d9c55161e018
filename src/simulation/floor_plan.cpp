#include "lstm_planner/simulation/floor_plan.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "simulation/building.hpp"

namespace lstm_planner {
namespace {

constexpr double kLongestSide = 500.0;

void check(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) + ", expected a number in [" +
                              std::to_string(low) + ", " + std::to_string(high) + "]");
}

}  // namespace

void validate(const FloorPlanParameters& parameters) {
  check("resolution", parameters.resolution, 0.01, 0.2);
  check("wall_thickness", parameters.wall_thickness, parameters.resolution, 1.0);
  check("door_width", parameters.door_width, 0.6, 3.0);
  check("smallest_room", parameters.smallest_room, parameters.door_width + 0.6, 50.0);
  const double shortest_side = parameters.smallest_room + 2.0 * (parameters.wall_thickness + parameters.resolution);
  check("width", parameters.width, shortest_side, kLongestSide);
  check("height", parameters.height, shortest_side, kLongestSide);
  check("extra_doors", parameters.extra_doors, 0.0, 1.0);
  check("furniture", parameters.furniture, 0.0, 0.5);
  check("smallest_gap", parameters.smallest_gap, 0.0, 5.0);
}

OccupancyGrid generateFloorPlan(const FloorPlanParameters& parameters, std::uint64_t seed) {
  validate(parameters);
  Random random(seed);
  Building building = buildRooms(parameters, random);
  furnish(parameters, random, &building);
  return building.grid;
}

}  // namespace lstm_planner
