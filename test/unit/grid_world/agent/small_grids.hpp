#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// A start and a goal, both passable and apart, in a small grid.
struct SmallGrid {
  PassableGrid grid;
  CellIndex start;
  CellIndex goal;
};

/// `#` is blocked, `S` the start, `G` the goal.
SmallGrid drawnGrid(const std::vector<std::string>& rows);

/// 3 to 20 cells wide and high with 10 to 50 % of them blocked, or, every fourth, a maze whose corridors are 1 to 3
/// wide.
SmallGrid smallGrid(std::uint32_t seed);

/// A goal two cells above the start, at the end of a path that first bends 1,600 times and then leads back: more than
/// boundary following can remember.
SmallGrid pathOfBends();

enum class WalkEnd { kArrived, kNoPath, kCollided, kTooLong };

struct Walk {
  WalkEnd end = WalkEnd::kTooLong;
  std::size_t steps = 0;
};

Walk walk(const SmallGrid& world, GridAgent* agent, CornerCutting corner_cutting, std::size_t most_steps);

}  // namespace lstm_planner
