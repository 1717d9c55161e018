#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// The kinds of worlds that networks learn in and are judged in.
enum class WorldKind {
  kMaze,       ///< 0.8 to 1.6 m wide corridors, perfect or with loops
  kOffice,     ///< floor plans with furniture
  kCorridors,  ///< corridors of different widths with dead ends
  kForest,     ///< poles at random, half of the forests with narrow gaps that are all wide enough
  kOpen,       ///< nothing in sight
  kRooms,      ///< empty rooms with doors
  kFurnished   ///< floor plans full of furniture, 0.4 to 0.8 m apart
};

/// All of them.
const std::vector<WorldKind>& worldKinds();

/// "mazes", "offices", "corridors", "forest", "open", "rooms", "furnished".
const char* toString(WorldKind kind);
/// Throws std::invalid_argument with the names there are.
WorldKind worldKindOf(const std::string& name);

/// A world of that kind, its size and everything else about it drawn from the seed; the same on every machine. There
/// are places at least 5 m of path apart for a disc of the Create 2's radius and 7 cm of clearance.
OccupancyGrid generateWorld(WorldKind kind, std::uint64_t seed);

/// What a world is for. No world that a network is judged in may be one that it has learnt in.
enum class WorldUse { kTraining, kValidation, kJudging };

/// The seed of the `number`-th world that belongs to `seed`. The two highest bits are those of the use (00 training, 01
/// validation during training, 1x judging, which is what `lstm_planner drive` does), so that the uses never share a
/// world whatever seeds are chosen.
std::uint64_t worldSeed(WorldUse use, std::uint64_t seed, std::uint64_t number);

}  // namespace lstm_planner
