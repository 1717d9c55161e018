#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/base/grid/map_generators.hpp"
#include "lstm_planner/base/grid/map_server_map.hpp"
#include "lstm_planner/grid_world/world/map_set.hpp"
#include "lstm_planner/robot/simulation/floor_plan.hpp"
#include "tools/command.hpp"
#include "tools/options.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"

namespace lstm_planner {
namespace {

namespace po = boost::program_options;

/// What can be generated, and the options that say how; options that all kinds have are not among them.
struct Kind {
  const char* name;
  std::vector<std::string> options;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"building", {"width", "height", "resolution", "smallest-room", "door-width", "extra-doors", "furniture"}},
      {"maze", {"count", "name", "per-bucket", "columns", "rows", "corridor-width", "branching"}},
      {"random", {"count", "name", "per-bucket", "columns", "rows", "share", "keep-pockets"}},
      {"rooms", {"count", "name", "per-bucket", "columns", "rows", "room-size", "door-cells", "extra-doors"}},
      {"caves", {"count", "name", "per-bucket", "columns", "rows", "share", "rounds"}},
  };
  return all;
}

bool hasOption(const Kind& kind, const std::string& option) {
  return std::find(kind.options.begin(), kind.options.end(), option) != kind.options.end();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  }
  return text;
}

std::string kindsWith(const std::string& option) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) {
    if (hasOption(kind, option)) names.emplace_back(kind.name);
  }
  return joined(names);
}

/// Refuses an unknown kind and given options that it would silently ignore.
void checkKind(const std::string& name, const po::variables_map& values) {
  const auto kind =
      std::find_if(kinds().begin(), kinds().end(), [&](const Kind& candidate) { return candidate.name == name; });
  if (kind == kinds().end()) {
    std::vector<std::string> names;
    for (const Kind& candidate : kinds()) names.emplace_back(candidate.name);
    throw std::invalid_argument("option --kind is '" + name + "', expected " + joined(names));
  }
  for (const auto& [option, value] : values) {
    const std::string users = kindsWith(option);
    if (value.defaulted() || users.empty() || hasOption(*kind, option)) continue;
    throw std::invalid_argument("option --" + option + " does not go with --kind " + name + ", expected --kind " +
                                users);
  }
}

/// All that can be asked for. What several kinds share is written by the user once and copied by finish().
struct MapsOptions {
  std::string kind = "building";
  std::string output;
  FloorPlanParameters plan;
  MazeParameters maze;
  RandomFillParameters random;
  RoomParameters rooms;
  CaveParameters caves;
  MapSet set;
  int columns = 512;
  int rows = 512;
  bool keep_pockets = false;
};

/// A number with a default that --help shows as a person would write it.
po::typed_value<double>* number(double* value) {
  std::ostringstream text;
  text << *value;
  return po::value(value)->default_value(*value, text.str());
}

po::options_description describe(MapsOptions* options) {
  FloorPlanParameters& plan = options->plan;
  po::options_description all;
  // clang-format off
  all.add_options()
      ("kind", po::value(&options->kind)->default_value(options->kind),
       "building: a floor plan in metres as a map_server map; maze, random, rooms, caves: maps and scenarios in cells in "
       "the layout of the grid benchmark (movingai.com)")
      ("output", po::value(&options->output)->required(),
       "building: path without extension, .yaml and .pgm are written; other kinds: folder, Maps/ and Scenarios/ in it "
       "are written")
      ("seed", po::value(&options->set.seed)->default_value(options->set.seed), "of the floor plan or of the first map");
  po::options_description building("--kind building");
  building.add_options()
      ("width", number(&plan.width), "m")
      ("height", number(&plan.height), "m")
      ("resolution", number(&plan.resolution), "m a cell")
      ("smallest-room", number(&plan.smallest_room), "m, shortest side")
      ("door-width", number(&plan.door_width), "m")
      ("extra-doors", po::value<double>(),
       "probability of a second way through a wall (building: 0.3), of a door in a wall that needs none (rooms: 0.5)")
      ("furniture", number(&plan.furniture), "share of the floor");
  po::options_description grid("--kind maze, random, rooms or caves");
  grid.add_options()
      ("count", po::value(&options->set.count)->default_value(options->set.count), "maps, of seeds that follow each other")
      ("name", po::value(&options->set.name), "of the maps, number and .map are added; default by kind and size")
      ("per-bucket", po::value(&options->set.scenarios.per_bucket)->default_value(options->set.scenarios.per_bucket),
       "scenarios for every 4 cells of length")
      ("columns", po::value(&options->columns)->default_value(options->columns), "cells")
      ("rows", po::value(&options->rows)->default_value(options->rows), "cells")
      ("corridor-width", po::value(&options->maze.corridor_width)->default_value(options->maze.corridor_width),
       "maze: cells")
      ("branching", number(&options->maze.branching),
       "maze: 0 for long winding ways, 1 for short ones with many dead ends")
      ("share", po::value<double>(), "of blocked cells, random: 0.25, caves: 0.45 (before smoothing)")
      ("keep-pockets", po::bool_switch(&options->keep_pockets), "random: do not fill what cannot be reached")
      ("room-size", po::value(&options->rooms.room_size)->default_value(options->rooms.room_size), "rooms: cells")
      ("door-cells", po::value(&options->rooms.door_cells)->default_value(options->rooms.door_cells),
       "rooms: width of a door, cells")
      ("rounds", po::value(&options->caves.rounds)->default_value(options->caves.rounds), "caves: of smoothing");
  // clang-format on
  all.add(building).add(grid);
  return all;
}

void finish(const po::variables_map& values, MapsOptions* options) {
  if (values.count("extra-doors") > 0) {
    options->plan.extra_doors = options->rooms.extra_doors = values["extra-doors"].as<double>();
  }
  if (values.count("share") > 0) {
    options->random.share = options->caves.share = values["share"].as<double>();
  }
  options->random.fill_pockets = !options->keep_pockets;
  options->maze.columns = options->random.columns = options->rooms.columns = options->caves.columns = options->columns;
  options->maze.rows = options->random.rows = options->rooms.rows = options->caves.rows = options->rows;
}

/// Validates, so that nothing is made for bad parameters, and leaves the generator and the default name in the set.
template <typename Parameters, typename Generate>
void take(const Parameters& parameters, Generate generate, const std::string& detail, MapsOptions* options) {
  validate(parameters);
  options->set.generate = [parameters, generate](std::uint64_t seed) { return generate(parameters, seed); };
  if (options->set.name.empty()) options->set.name = options->kind + std::to_string(options->columns) + "-" + detail;
}

void chooseGenerator(MapsOptions* options) {
  const auto percent = [](double share) { return std::to_string(std::lround(100.0 * share)); };
  if (options->kind == "maze") {
    take(options->maze, generateMaze, std::to_string(options->maze.corridor_width), options);
  } else if (options->kind == "random") {
    take(options->random, generateRandomFill, percent(options->random.share), options);
  } else if (options->kind == "rooms") {
    take(options->rooms, generateRooms, std::to_string(options->rooms.room_size), options);
  } else {
    take(options->caves, generateCaves, percent(options->caves.share), options);
  }
}

void writeGridMaps(MapsOptions* options) {
  chooseGenerator(options);
  validate(options->set);
  makeOutputFolder(options->output + "/Maps");
  makeOutputFolder(options->output + "/Scenarios");
  Progress progress;
  const std::size_t scenarios = writeMapSet(options->output, options->set, [&](double share) { progress.show(share); });
  std::cout << options->set.count << (options->set.count == 1 ? " map and " : " maps and ") << scenarios
            << " scenarios in " << options->output << "\n";
}

}  // namespace

int runMaps(const std::vector<std::string>& arguments) {
  MapsOptions options;
  const po::options_description description = describe(&options);
  po::variables_map values;
  if (!parseOptions("maps", description, arguments, &values)) {
    return 0;
  }
  checkKind(options.kind, values);
  finish(values, &options);
  if (options.kind == "building") {
    validate(options.plan);
    writeMapServerMap(options.output, generateFloorPlan(options.plan, options.set.seed));
  } else {
    writeGridMaps(&options);
  }
  return 0;
}

}  // namespace lstm_planner
