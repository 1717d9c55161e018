#pragma once

#include <string>
#include <vector>

#include "lstm_planner/base/network/model_file.hpp"
#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"
#include "tools/train_grid_options.hpp"

namespace lstm_planner {

/// What a network scores on the validation scenarios, with the shield alone.
struct GridScore {
  std::vector<double> success;  ///< share of each set's scenarios that arrived
  double mean = 0.0;            ///< over the sets
};

/// Judges networks while they learn, and keeps the best in the output file.
class GridJudge {
 public:
  GridJudge(const GridTrainingOptions& options, std::vector<GridTaskSet> sets);

  GridScore judge(const LayerStack& layers) const;

  /// Writes the model when it is better than all before. Returns whether it was.
  bool keepIfBest(const LayerStack& layers, const GridScore& score);

  double best() const { return best_; }  ///< mean arrival; -1 before the first
  /// For a checkpoint, and from it: the best is in the output file, unless that is another now, or was taken away.
  nlohmann::json state() const;
  void restore(const nlohmann::json& state);
  std::vector<std::string> names() const;

 private:
  GridTrainingOptions options_;
  std::vector<GridTaskSet> sets_;
  double best_ = -1.0;
};

}  // namespace lstm_planner
