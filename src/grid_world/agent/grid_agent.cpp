#include "lstm_planner/grid_world/agent/grid_agent.hpp"

#include <array>

namespace lstm_planner {

const char* nameOf(GridLeader leader) {
  constexpr std::array<const char*, kGridLeaderCount> kNames = {"network", "search", "boundary", "greedy"};
  return kNames[static_cast<std::size_t>(leader)];
}

}  // namespace lstm_planner
