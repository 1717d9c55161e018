#include <cmath>
#include <iostream>
#include <optional>
#include <stdexcept>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/grid_world/world/map_set.hpp"
#include "lstm_planner/simulation/floor_plan.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"

namespace lstm_planner {
namespace {

constexpr Range kMapSide{1, 8192};  // cells

/// What can be generated, and the options that say how; options that all kinds have are not among them.
const Choices<std::vector<std::string>> kMapKinds = {
    {"building", {"width", "height", "resolution", "smallest-room", "door-width", "extra-doors", "furniture"}},
    {"maze", {"count", "name", "per-bucket", "columns", "rows", "corridor-width", "branching"}},
    {"random", {"count", "name", "per-bucket", "columns", "rows", "share", "keep-pockets"}},
    {"rooms", {"count", "name", "per-bucket", "columns", "rows", "room-size", "door-cells", "extra-doors"}},
    {"caves", {"count", "name", "per-bucket", "columns", "rows", "share", "rounds"}},
};

std::vector<std::string> kindsWith(const std::string& option) {
  std::vector<std::string> names;
  for (const auto& [name, options] : kMapKinds) {
    if (contains(options, option)) names.push_back(name);
  }
  return names;
}

/// Refuses given options that the kind would silently ignore.
void checkKind(const std::string& kind, const CommandLine& line) {
  for (const auto& [name, options] : kMapKinds) {
    for (const std::string& option : options) {
      const std::vector<std::string> having = kindsWith(option);
      if (!line.given(option) || contains(having, kind)) continue;
      throw std::invalid_argument("option --" + option + " cannot be used with --kind " + kind + ", expected --kind " +
                                  joinedByOr(having));
    }
  }
}

/// All that can be asked for.
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
  std::optional<double> extra_doors;
  std::optional<double> share;
};

void addBuildingOptions(FloorPlanParameters* plan, CommandLine* line) {
  line->section("--kind building");
  visitFloorPlanParameters(
      *plan,
      onlyNamed({"width", "height", "resolution", "smallest_room", "door_width", "furniture"}, line->everyParameter()));
}

void addGridMapOptions(MapsOptions* options, CommandLine* line) {
  line->section("--kind maze, random, rooms or caves");
  line->add("count", &options->set.count, {1, 1e5}, "number of maps, with consecutive seeds");
  line->add("name", &options->set.name,
            "name of the maps; a number and .map are added; the default depends on kind and size");
  line->add("per-bucket", &options->set.scenarios.per_bucket, {1, 1e4}, "scenarios for each 4 cells of path length");
  line->add("columns", &options->columns, kMapSide, "cells");
  line->add("rows", &options->rows, kMapSide, "cells");
  line->add("corridor-width", &options->maze.corridor_width, kMapSide, "maze: width of the corridors, cells");
  line->add("branching", &options->maze.branching, kAnyShare,
            "maze: 0 for long winding paths, 1 for short ones with many dead ends");
  line->add("share", &options->share, kAnyShare,
            "share of blocked cells (default: random 0.25, caves 0.45, before smoothing)");
  line->addFlag("keep-pockets", &options->random.fill_pockets, false, "random: keep free cells that cannot be reached");
  line->add("room-size", &options->rooms.room_size, kMapSide, "rooms: size of a room, cells");
  line->add("door-cells", &options->rooms.door_cells, kMapSide, "rooms: width of a door, cells");
  line->add("rounds", &options->caves.rounds, {0, 100}, "caves: rounds of smoothing");
}

/// What several kinds share is written by the user once.
void shareAmongKinds(MapsOptions* options) {
  if (options->extra_doors) options->plan.extra_doors = options->rooms.extra_doors = *options->extra_doors;
  if (options->share) options->random.share = options->caves.share = *options->share;
  options->maze.columns = options->random.columns = options->rooms.columns = options->caves.columns = options->columns;
  options->maze.rows = options->random.rows = options->rooms.rows = options->caves.rows = options->rows;
}

bool readOptions(const std::vector<std::string>& arguments, MapsOptions* options) {
  CommandLine line("maps", "generates floor plans, or maps and scenarios of the grid world");
  line.addChoice("kind", &options->kind, namesOf(kMapKinds),
                 "building: a floor plan in metres, as a map for map_server; maze, random, rooms, caves: maps and "
                 "scenarios in cells, in the format of the MovingAI benchmark (movingai.com)");
  line.addFile(
          "output", &options->output,
          "building: path without extension, .yaml and .pgm are added; other kinds: folder for Maps/ and Scenarios/")
      .required();
  line.addSeed(&options->set.seed, "seed of the floor plan, or of the first map");
  line.add("extra-doors", &options->extra_doors, kAnyShare,
           "probability of an additional door in a wall (default: building 0.3, rooms 0.5)");
  addBuildingOptions(&options->plan, &line);
  addGridMapOptions(options, &line);
  line.whenParsed([&] {
    checkKind(options->kind, line);
    shareAmongKinds(options);
  });
  return line.parse(arguments);
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
  if (!readOptions(arguments, &options)) return 0;
  if (options.kind == "building") {
    validate(options.plan);
    checkWithoutExtension(options.output, {".yaml", ".pgm"});
    writeMapServerMap(options.output, generateFloorPlan(options.plan, options.set.seed));
  } else {
    writeGridMaps(&options);
  }
  return 0;
}

}  // namespace lstm_planner
