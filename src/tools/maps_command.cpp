#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/simulation/floor_plan.hpp"
#include "tools/command.hpp"
#include "tools/options.hpp"

namespace lstm_planner {

int runMaps(const std::vector<std::string>& arguments) {
  namespace po = boost::program_options;
  FloorPlanParameters plan;
  std::uint64_t seed = 1;
  std::string output;
  po::options_description description;
  // clang-format off
  description.add_options()
      ("output", po::value(&output)->required(), "path without extension; .yaml and .pgm are written")
      ("seed", po::value(&seed)->default_value(seed), "of the floor plan")
      ("width", po::value(&plan.width)->default_value(plan.width), "m")
      ("height", po::value(&plan.height)->default_value(plan.height), "m")
      ("resolution", po::value(&plan.resolution)->default_value(plan.resolution), "m a cell")
      ("smallest-room", po::value(&plan.smallest_room)->default_value(plan.smallest_room), "m, shortest side")
      ("door-width", po::value(&plan.door_width)->default_value(plan.door_width), "m")
      ("extra-doors", po::value(&plan.extra_doors)->default_value(plan.extra_doors), "probability a wall")
      ("furniture", po::value(&plan.furniture)->default_value(plan.furniture), "share of the floor");
  // clang-format on
  po::variables_map values;
  if (!parseOptions("maps", description, arguments, &values)) {
    return 0;
  }
  validate(plan);
  writeMapServerMap(output, generateFloorPlan(plan, seed));
  return 0;
}

}  // namespace lstm_planner
