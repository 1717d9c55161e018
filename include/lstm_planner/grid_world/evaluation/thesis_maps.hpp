#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"

namespace lstm_planner {

/// The maps of the thesis's training (Table 3.1) and of its tests (Tables 3.7-3.9).
struct ThesisMaps {
  std::vector<GridMapFiles> training;    ///< five maps: mazes of width 2 and 4, random fill 25 and 40 %
  std::vector<GridMapFiles> validation;  ///< three others of these sets
  /// At most ten maps of each set that has a table in the thesis, and none of the maps for training.
  std::vector<GridSetFiles> tests;
};

/// Draws them from the sets, which are found by their names. Throws std::invalid_argument naming the sets if one for
/// training is missing or has too few maps, or if there is none to test in.
ThesisMaps chooseThesisMaps(const std::vector<GridSetFiles>& sets, std::uint64_t seed);

}  // namespace lstm_planner
