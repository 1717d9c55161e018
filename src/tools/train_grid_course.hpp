#pragma once

#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "lstm_planner/network/model_file.hpp"
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

/// What a network scores on the validation scenarios, with the shield alone.
struct GridScore {
  std::vector<double> success;  ///< share of each set's scenarios that arrived
  double mean = 0.0;            ///< over the sets
};

/// Judges networks while they learn, and writes them to the output file.
class GridJudge {
 public:
  GridJudge(const GridTrainingOptions& options, std::vector<GridTaskSet> sets);

  GridScore judge(const LayerStack& layers) const;
  void write(const LayerStack& layers, const GridScore& score) const;
  std::vector<std::string> names() const;

 private:
  GridTrainingOptions options_;
  std::vector<GridTaskSet> sets_;
};

}  // namespace lstm_planner
