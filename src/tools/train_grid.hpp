#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"
#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/training_loop.hpp"
#include "tools/command_line.hpp"
#include "tools/training.hpp"

namespace lstm_planner {

/// Options that all ways of training in the grid world have in common.
struct GridTrainingOptions {
  std::string command;  ///< the whole command line
  std::string task = "grid";
  std::string method;
  std::vector<std::string> maps;  ///< folders of benchmark sets; none: generated maps
  int map_size = 256;             ///< cells, of generated maps
  double min_length = 10.0;       ///< cells, of the shortest path
  double max_length = 300.0;
  double dead_ends = 0.0;  ///< share of the training episodes that start in one
  PassableRule rule = PassableRule::kBenchmark;
  CornerCutting corner_cutting = CornerCutting::kForbidden;  ///< in training and judging
  NetworkShape shape;
  std::string from;  ///< model file to start with; decides the shape
  std::string curve;
  TrainingLoopOptions loop;
  int epochs = 0;
  int validation = 300;  ///< scenarios of each set
  int max_steps = 1000;  ///< of a validation episode
  std::uint64_t seed = 1;
  int threads = 2;
};

// `options` hold the defaults and take the values; they must stay where they are until the line is parsed.

/// Maps, lengths, epochs, seed and threads: what the search has, too.
void addGridMapOptions(GridTrainingOptions* options, CommandLine* line);

/// Those, and the network, the judging and the files. What the line then refuses: networks that cannot be, and files
/// that cannot be written.
void addGridTrainingOptions(const std::vector<std::string>& arguments, GridTrainingOptions* options, CommandLine* line);

/// What the options say of the paths to learn from, and of how.
template <typename Parameters>
void takeOver(const GridTrainingOptions& options, Parameters* parameters) {
  parameters->course.min_length = options.min_length;
  parameters->course.max_length = options.max_length;
  parameters->course.dead_end_share = options.dead_ends;
  parameters->course.corner_cutting = options.corner_cutting;
  parameters->seed = options.seed;
  parameters->threads = options.threads;
}

/// The network to start with: random, or that of `from`.
LayerStack firstLayers(const GridTrainingOptions& options);

/// The maps to learn on, and scenarios of other maps to judge by, set by set.
struct GridTrainingMaps {
  std::vector<GridCourse::Set> training;
  std::vector<GridTaskSet> validation;
};

/// Of the folders, or generated. Throws std::invalid_argument for folders and weights that cannot be used and
/// MovingAiFileError for files.
GridTrainingMaps loadGridTrainingMaps(const GridTrainingOptions& options);

/// The validation scenarios' maps.
std::vector<GridCourse::Set> validationMaps(const GridTrainingMaps& maps);

/// Judges networks while they learn, by the mean of success(), and writes them to the output file.
class GridTrainingHost : public ToolTrainingHost {
 public:
  /// `sets`: of validation scenarios. `options` must outlive the host.
  GridTrainingHost(const GridTrainingOptions& options, std::vector<GridTaskSet> sets);

  double judge(const LayerStack& layers) final;
  void keep(const LayerStack& layers) final;

 protected:
  std::vector<std::string> names() const;  ///< of the sets
  /// Share of each set's scenarios in which the network that was judged last arrived, with the shield alone.
  const std::vector<double>& success() const { return success_; }

 private:
  std::string scoreText(double score) const final;

  const GridTrainingOptions& options_;
  std::vector<GridTaskSet> sets_;
  std::vector<double> success_;
};

}  // namespace lstm_planner
