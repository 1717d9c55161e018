#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"

namespace lstm_planner {

/// The maps of the thesis's training (Table 3.1) and of its tests (Tables 3.7-3.9).
struct ThesisMaps {
  std::vector<GridMapFiles> training;    ///< five maps: mazes of width 2 and 4, random fill 25 and 40 %
  std::vector<GridMapFiles> validation;  ///< three others of these sets
  /// Of each set that has a table in the thesis at most ten maps, none of them one of the training.
  std::vector<GridSetFiles> tests;
};

/// Draws them from the sets, which are told by their names. Throws std::invalid_argument naming the sets when one of
/// the training's is missing or has too few maps, or there is none to test in.
ThesisMaps chooseThesisMaps(const std::vector<GridSetFiles>& sets, std::uint64_t seed);

}  // namespace lstm_planner
