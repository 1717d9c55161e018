#include "lstm_planner/simulation/generated_world.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/simulation/floor_plan.hpp"

namespace lstm_planner {
namespace {

int drawCount(Random& random, int low, int high) {
  return low + static_cast<int>(uniformIndex(random, static_cast<std::size_t>(high - low + 1)));
}

OccupancyGrid drawMaze(Random& random) {
  MazeWorldParameters maze;
  maze.columns = drawCount(random, 5, 10);
  maze.rows = drawCount(random, 5, 10);
  maze.corridor_width = uniform(random, 0.8, 1.6);
  maze.wall_thickness = uniform(random, 0.1, 0.3);
  maze.branching = uniform(random, 0.0, 0.3);
  maze.loops = uniform(random) < 0.5 ? 0.0 : uniform(random, 0.02, 0.15);
  return generateMazeWorld(maze, random());
}

OccupancyGrid drawOffice(Random& random) {
  FloorPlanParameters plan;
  plan.width = uniform(random, 12.0, 26.0);
  plan.height = uniform(random, 10.0, 18.0);
  plan.smallest_room = uniform(random, 2.4, 4.5);
  plan.door_width = uniform(random, 0.75, 1.2);
  plan.extra_doors = uniform(random, 0.0, 0.6);
  plan.furniture = uniform(random, 0.02, 0.12);
  plan.smallest_gap = uniform(random, 0.55, 0.9);
  return generateFloorPlan(plan, random());
}

OccupancyGrid drawFurnished(Random& random) {
  FloorPlanParameters plan;
  plan.width = uniform(random, 10.0, 18.0);
  plan.height = uniform(random, 8.0, 14.0);
  plan.resolution = 0.02;
  plan.smallest_room = uniform(random, 3.0, 5.0);
  plan.furniture = 0.5;  // as much as finds room
  plan.tries = 1000;
  plan.smallest_gap = uniform(random, 0.4, 0.6);
  return generateFloorPlan(plan, random());
}

OccupancyGrid drawCorridors(Random& random) {
  CorridorWorldParameters corridors;
  corridors.width = uniform(random, 12.0, 24.0);
  corridors.height = uniform(random, 10.0, 20.0);
  corridors.corridors = drawCount(random, 8, 18);
  corridors.narrowest = uniform(random, 0.75, 1.0);
  corridors.widest = uniform(random, 1.0, 2.2);
  return generateCorridorWorld(corridors, random());
}

OccupancyGrid drawForest(Random& random) {
  ForestParameters forest;
  forest.width = uniform(random, 9.0, 16.0);
  forest.height = uniform(random, 4.0, 14.0);
  forest.density = uniform(random, 0.01, 0.08);
  forest.smallest_radius = uniform(random, 0.03, 0.1);
  forest.largest_radius = uniform(random, forest.smallest_radius, 0.3);
  // Half of a cell's diagonal is lost on either side where poles are drawn, and again where distances are measured.
  const double narrow = 2.0 * (forest.passage + 1.5 * forest.resolution);
  forest.gap = uniform(random) < 0.5 ? 0.0 : narrow;
  return generateForest(forest, random());
}

/// Nothing anywhere, not even a wall around it. The size is that of the part in which goals lie.
OccupancyGrid drawOpenField(Random& random) {
  constexpr double kResolution = 0.1;  // m
  const auto drawCells = [&] { return static_cast<int>(std::ceil(uniform(random, 10.0, 40.0) / kResolution)); };
  const int columns = drawCells();
  const int rows = drawCells();
  return OccupancyGrid(columns, rows, kResolution);
}

OccupancyGrid drawRooms(Random& random) {
  RoomsWorldParameters rooms;
  rooms.columns = drawCount(random, 2, 5);
  rooms.rows = drawCount(random, 2, 4);
  rooms.room_size = uniform(random, 2.5, 6.0);
  rooms.door_width = uniform(random, 0.8, 1.3);
  rooms.extra_doors = uniform(random, 0.0, 0.6);
  return generateRoomsWorld(rooms, random());
}

struct Kind {
  const char* name;
  OccupancyGrid (*draw)(Random& random);
};

/// In the order of WorldKind.
constexpr std::array<Kind, 7> kKinds{{{"mazes", drawMaze},
                                      {"offices", drawOffice},
                                      {"corridors", drawCorridors},
                                      {"forest", drawForest},
                                      {"open", drawOpenField},
                                      {"rooms", drawRooms},
                                      {"furnished", drawFurnished}}};

const Kind& kindOf(WorldKind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }

}  // namespace

const std::vector<WorldKind>& worldKinds() {
  static const std::vector<WorldKind> kinds{WorldKind::kMaze,     WorldKind::kOffice, WorldKind::kCorridors,
                                            WorldKind::kForest,   WorldKind::kOpen,   WorldKind::kRooms,
                                            WorldKind::kFurnished};
  return kinds;
}

const char* toString(WorldKind kind) { return kindOf(kind).name; }

WorldKind worldKindOf(const std::string& name) {
  std::vector<std::string> names;
  for (const WorldKind kind : worldKinds()) {
    if (name == toString(kind)) return kind;
    names.emplace_back(toString(kind));
  }
  throw std::invalid_argument("there is no kind of worlds '" + name + "', expected one of " + joined(names));
}

OccupancyGrid generateWorld(WorldKind kind, std::uint64_t seed) {
  Random random(seed);
  return kindOf(kind).draw(random);
}

std::uint64_t worldSeed(WorldUse use, std::uint64_t seed, std::uint64_t number) {
  constexpr std::uint64_t kJudgingBit = std::uint64_t{1} << 63;
  constexpr std::uint64_t kValidationBit = std::uint64_t{1} << 62;
  const std::uint64_t draw = Random(seed * 1000003ULL + number)() & ~(kJudgingBit | kValidationBit);
  switch (use) {
    case WorldUse::kTraining:
      return draw;
    case WorldUse::kValidation:
      return draw | kValidationBit;
    case WorldUse::kJudging:
      break;
  }
  return draw | kJudgingBit;
}

}  // namespace lstm_planner
