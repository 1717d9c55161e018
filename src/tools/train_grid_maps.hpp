#pragma once

#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "tools/train_grid_options.hpp"

namespace lstm_planner {

/// The maps to learn on, and scenarios of other maps to judge by, set by set.
struct GridTrainingMaps {
  std::vector<GridCourse::Set> training;
  std::vector<GridTaskSet> validation;
  std::vector<double> weights;  ///< of the sets, > 0
};

/// Of the folders, or generated. Throws std::invalid_argument for folders and weights that cannot be used and
/// MovingAiFileError for files.
GridTrainingMaps loadGridTrainingMaps(const GridTrainingOptions& options);

/// The validation scenarios' maps with the sets' weights.
std::vector<GridCourse::Set> validationMaps(const GridTrainingMaps& maps);

}  // namespace lstm_planner
