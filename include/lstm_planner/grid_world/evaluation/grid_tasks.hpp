#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner {

/// A map of a benchmark set. The benchmark for several agents (MAPF) has 50 scenario files for each.
struct GridMapFiles {
  std::string name;                         ///< as the scenarios name it, without folders and `.map`
  std::vector<std::string> scenario_files;  ///< in the order of their names, at least one
};

/// A benchmark set: the maps that the scenario files of one folder name, in the order of the files' names.
struct GridSetFiles {
  std::string name;  ///< of the folder above `Scenarios`; else of the folder itself
  std::vector<GridMapFiles> maps;
};

/// The sets in a folder. `folder` is a set with `Scenarios` and `Maps` in it, or its `Scenarios`, or holds `.scen`
/// files beside their maps, or is a folder of such sets, or holds one as `scenarios`. If the maps' names are
/// NAME-NUMBER with several NAMEs, as in the benchmark's archives of mazes and of random maps, each NAME is a set.
/// Throws std::invalid_argument if there is no scenario file, and MovingAiFileError if the first scenario of a file
/// cannot be read.
std::vector<GridSetFiles> findGridSets(const std::string& folder);

/// Which maps of a set take part. Learning keeps to the maps numbered 0 to 5 of a set (the number at the end of the
/// name, else the place in the order of the names) and, in sets of more than 20 maps, to the first half by name; the
/// others validate.
enum class MapSelection { kAll, kTrain, kValidation };

/// Which scenarios of a benchmark set take part.
struct ScenarioSelection {
  MapSelection maps = MapSelection::kAll;
  double min_length = 0.0;  ///< cells, of the shortest path, inclusive
  double max_length = std::numeric_limits<double>::infinity();
  std::size_t count = 0;  ///< of a set, drawn without repetition; 0 = all
  std::uint64_t seed = 1;
  PassableRule rule = PassableRule::kBenchmark;
};

/// The maps that take part.
std::vector<GridMapFiles> selectMaps(const GridSetFiles& files, MapSelection selection);

/// A path that an agent has to find.
struct GridTask {
  std::size_t map = 0;  ///< place in GridTaskSet::maps
  CellIndex start;
  CellIndex goal;
  double optimal_length = 0.0;  ///< cells, without corner cutting; see allowCornerCutting()
};

/// The tasks on which an agent is judged in one set.
struct GridTaskSet {
  std::string name;
  std::vector<std::string> map_names;
  std::vector<PassableGrid> maps;
  std::vector<GridTask> tasks;  ///< map by map
  /// Scenarios of the selected maps and lengths that were left out because their goal cannot be reached, which the
  /// benchmark marks with the length 0: a hundred of Dragon Age's hundred thousand.
  std::size_t without_path = 0;
  /// Scenarios that were drawn and left out because they start or end on a cell that is not passable: in water or
  /// trees, and a few of the benchmark in walls. Others were drawn in their place.
  std::size_t with_blocked_end = 0;
};

/// Draws from a set's scenarios; the same for the same seed, also if other sets are drawn. Reads only the maps of the
/// scenarios that are drawn. Throws MovingAiFileError for files that cannot be used, and std::invalid_argument if no
/// scenario is left.
GridTaskSet drawGridTasks(const GridSetFiles& files, const ScenarioSelection& selection);

/// For agents that may cut corners: the optimal lengths become those with corner cutting, which the files do not have.
/// A task without a path keeps its own.
void allowCornerCutting(GridTaskSet* set, int threads);

}  // namespace lstm_planner
