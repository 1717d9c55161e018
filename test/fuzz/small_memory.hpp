#pragma once

#include "lstm_planner/drive/decision/agent_parameters.hpp"

namespace lstm_planner::fuzz {

/// An obstacle memory of 128 x 128 squares, as small as it gets: a harness makes one for each input.
inline MemoryParameters smallMemory() {
  MemoryParameters memory;
  memory.width = 6.4;
  return memory;
}

}  // namespace lstm_planner::fuzz
